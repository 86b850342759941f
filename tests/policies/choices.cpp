// Tests of simple choices among providers, of filters before them, and of
// admission by room.
#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::world;
using test::goes_to;
using test::is_accepted;
using test::on_board;

namespace {

const std::vector<point> path{{0, 0}, {200, 0}};

/// Three providers along the way, each with its utilisation.
std::vector<provider_view> three(double a = 0, double b = 0, double c = 0) {
  return {{1, {100, 0}, a}, {2, {20, 10}, b}, {3, {150, 20}, c}};
}

service_place choose(local_policy& lodm,
                     const std::vector<provider_view>& among,
                     std::uint64_t number = 0) {
  return goes_to(lodm.decide(
      {time_point{}, "any", among, path, 10, random_stream{1, "x"}, number}));
}

/// How often each is chosen in 3000 decisions.
std::map<service_place, int> choices(local_policy& lodm,
                                     const std::vector<provider_view>& among) {
  std::map<service_place, int> counts;
  for (std::uint64_t k = 0; k < 3000; ++k)
    ++counts[choose(lodm, among, k)];
  return counts;
}

} // namespace

TEST_CASE("nobody is chosen where nobody offers") {
  for (const auto name : lodm_names())
    CHECK(choose(*make_lodm(name), {}) == on_board);
}

TEST_CASE("the random choice asks as often as it is told, everybody alike") {
  const auto lodm = make_lodm("random");
  test::option_list options;
  options.numbers = {{"probability", 0.75}};
  lodm->visit_options(options);
  auto counts = choices(*lodm, three());
  CHECK(counts[on_board] == doctest::Approx(750).epsilon(0.1));
  for (provider_id::rep id = 1; id <= 3; ++id)
    CHECK(counts[id] == doctest::Approx(750).epsilon(0.1));
}

TEST_CASE("a decision that is made again is the same") {
  const auto lodm = make_lodm("random");
  for (std::uint64_t k = 0; k < 100; ++k)
    CHECK(choose(*lodm, three(), k) == choose(*lodm, three(), k));
}

TEST_CASE("the nearest provider is the one nearest to the vehicle") {
  const auto lodm = make_lodm("nearest");
  CHECK(choose(*lodm, three()) == 2);
  CHECK(choose(*lodm, {{7, {5, 0}, 0.9}, {8, {6, 0}, 0}}) == 7);
}

TEST_CASE("of two the less loaded is chosen, and of three never the most "
          "loaded") {
  const auto lodm = make_lodm("least_loaded");
  CHECK(choices(*lodm, {{1, {}, 0.6}, {2, {}, 0.5}})[2] == 3000);
  auto counts = choices(*lodm, three(0.3, 0.2, 0.9));
  CHECK(counts[3] == 0);
  CHECK(counts[2] == doctest::Approx(2000).epsilon(0.1));
  CHECK(counts[1] == doctest::Approx(1000).epsilon(0.1));
}

TEST_CASE("who has no room is not asked, nor who talks nonsense") {
  const auto lodm = make_lodm("least_loaded");
  CHECK(choose(*lodm, {{1, {}, 1}}) == on_board);
  CHECK(choose(*lodm, {{1, {}, 0.99}}) == 1);
  CHECK(choose(*lodm, {{1, {}, std::numeric_limits<double>::quiet_NaN()}})
        == on_board);
}

TEST_CASE("a choice is made among those that are near enough") {
  const auto lodm = make_lodm("nearest");
  // The second is nearer, but the way leads away from it.
  CHECK(choose(*lodm, {{1, {100, 200}, 0}, {2, {-150, -10}, 0}}) == 1);
  CHECK(choose(*lodm, {{2, {-10, -320}, 0}}) == on_board);
  CHECK(lodm->name() == "nearest");
}

TEST_CASE("a policy objects to whom its filter objects to, and tells so with "
          "governors behind it") {
  const std::vector<provider_view> all{{1, {100, 200}, 0}, {2, {-10, -320}, 0}};
  const std::vector<point> straight{{0, 0}, {200, 0}};
  const local_context context{.now = time_point{},
                              .service = "any",
                              .providers = all,
                              .path = straight};
  for (const auto* name : {"nearest", "location"}) {
    const auto lodm = make_lodm(name);
    CHECK(lodm->objection(context, all[0]).empty());
    CHECK(!lodm->objection(context, all[1]).empty());
  }
  test::option_list options;
  options.texts = {{"filter.name", "none"}};
  const auto unfiltered = make_lodm("nearest");
  unfiltered->visit_options(options);
  CHECK(unfiltered->objection(context, all[1]).empty());
}

TEST_CASE("a filter is an option, and a clone keeps it") {
  const auto lodm = make_lodm("nearest");
  test::option_list options;
  options.texts = {{"filter.name", "none"}};
  lodm->visit_options(options);
  CHECK(options.refused.empty());
  CHECK(choose(*lodm, {{2, {-10, -320}, 0}}) == 2);
  CHECK(choose(*lodm->clone(), {{2, {-10, -320}, 0}}) == 2);
}

TEST_CASE("an unknown filter is refused") {
  const auto lodm = make_lodm("nearest");
  test::option_list options;
  options.texts = {{"filter.name", "locaton"}};
  lodm->visit_options(options);
  CHECK(options.refused.contains("filter.name"));
}

namespace {

/// Decisions about vehicles on a street of 200 m, in an area as long.
struct short_street {
  const polygon area{{{-100, -100}, {200, -100}, {200, 100}, {-100, 100}}};
  const road_map map{
      "street",
      {},
      {{"street", {{-500, 0}, {500, 0}}, 1.75, {{0, 14}}, {}, 0}}};

  std::vector<bool> accepted(central_policy& codm, double used,
                             const std::vector<double>& shares,
                             double speed_mps = 10) const {
    std::vector<request_view> requests;
    for (const auto share : shares)
      requests.push_back({101, "any", path, speed_mps, share});
    std::vector<bool> all;
    for (const auto& d :
         codm.decide({time_point{}, requests, {}, used, 1, area, map}))
      all.push_back(is_accepted(d));
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(short_street,
                  "who fits is accepted, first come, first served") {
  const auto codm = make_codm("capacity");
  using all = std::vector<bool>;
  CHECK(accepted(*codm, 0, {0.5, 0.3, 0.01}) == all{true, true, false});
  CHECK(accepted(*codm, 0, {0.9, 0.3, 0.5}) == all{false, true, true});
  CHECK(accepted(*codm, 0.7, {0.2}) == all{false});
}

TEST_CASE_FIXTURE(short_street,
                  "who leaves too soon is refused, and takes no room from "
                  "those who stay") {
  const auto codm = make_codm("capacity");
  std::vector<request_view> requests;
  for (const auto& [speed_mps, share] : {std::pair{100.0, 0.5},
                                         {10.0, 0.5},
                                         {100.0, 0.5},
                                         {10.0, 0.4},
                                         {10.0, 0.3}})
    requests.push_back({101, "any", path, speed_mps, share});
  const auto all =
      codm->clone()->decide({time_point{}, requests, {}, 0, 1, area, map});
  std::vector<std::string> why;
  for (const auto& decision : all)
    why.emplace_back(reason::words_of(decision.why.text()));
  CHECK(why
        == std::vector<std::string>{"t_in_area < t_min", "there is room",
                                    "t_in_area < t_min", "no room",
                                    "there is room"});
  CHECK(is_accepted(all[1]));
  CHECK(!is_accepted(all[2]));
  CHECK(all[3].why.text() == "no room value=0.9 limit=0.8");
}
