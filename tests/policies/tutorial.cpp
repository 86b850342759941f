// The policies of docs/policies.md, as they are printed there.
#include "policies/entry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

namespace sofof::policies {

lodm_entry lodm_slow_only();
codm_entry codm_slowest_first();
} // namespace sofof::policies

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::world;
using test::goes_to;
using test::is_accepted;

namespace {

bool asks(local_policy& lodm, double speed_mps) {
  const std::vector<provider_view> one{{7, {0, 0}, 0}};
  const std::vector<point> path{{0, 0}, {100, 0}};
  return goes_to(lodm.decide({time_point{}, "any", one, path, speed_mps})) == 7;
}

} // namespace

TEST_CASE("the policy of the tutorial asks while the vehicle drives slowly") {
  const auto lodm = lodm_slow_only().make();
  CHECK(asks(*lodm, 8));
  CHECK(!asks(*lodm, 8.1));
}

TEST_CASE("the policy of the tutorial has an option, and stands behind a "
          "filter") {
  const auto lodm = lodm_slow_only().make();
  test::option_list options;
  options.numbers = {{"most_mps", 3}, {"filter.min_distance_m", 99}};
  lodm->visit_options(options);
  CHECK(asks(*lodm, 3));
  CHECK(!asks(*lodm, 4));
  options = {};
  options.numbers = {{"filter.min_distance_m", 101}};
  lodm->visit_options(options);
  CHECK(!asks(*lodm, 3));
}

TEST_CASE("the provider's policy of the tutorial gives the room to the slowest "
          "of an epoch") {
  const auto codm = codm_slowest_first().make();
  test::option_list options;
  options.texts = {{"filter.name", "none"}};
  codm->visit_options(options);
  CHECK(codm->epoch_s() == 0.25);
  const std::vector<point> route{{0, 0}};
  std::vector<request_view> asked;
  for (const auto speed_mps : {14.0, 3.0, 8.0})
    asked.push_back({1, "any", route, speed_mps, 0.3});
  const polygon area{{{0, 0}, {1, 0}, {1, 1}}};
  const road_map map{"street", {}, {}};
  const auto decided = codm->decide({time_point{}, asked, {}, 0, 1, area, map});
  REQUIRE(decided.size() == 3);
  CHECK(!is_accepted(decided[0]));
  CHECK(is_accepted(decided[1]));
  CHECK(is_accepted(decided[2]));
}
