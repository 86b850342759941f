// The policy of docs/policies.md, as it is printed there.
#include "policies/entry.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

namespace sofof {
lodm_entry lodm_slow_only();
} // namespace sofof

using namespace sofof;

namespace {

bool asks(local_policy& lodm, double speed_mps) {
  const std::vector<provider_view> one{{7, {0, 0}, 0}};
  const std::vector<point> path{{0, 0}, {100, 0}};
  return lodm.decide({time_point{}, "any", one, path, speed_mps}).source == 7;
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
  lodm->fields(options);
  CHECK(asks(*lodm, 3));
  CHECK(!asks(*lodm, 4));
  options = {};
  options.numbers = {{"filter.min_distance_m", 101}};
  lodm->fields(options);
  CHECK(!asks(*lodm, 3));
}
