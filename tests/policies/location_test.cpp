// Tests of the paper's decisions: the LODM's disc, the CODM's area and map.
#include "policies/filters/location.hpp"

#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/not_a_number.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::world;
using test::dice;
using test::goes_to;
using test::is_accepted;
using test::not_a_number;

namespace {

using namespace std::chrono_literals;

using line = std::vector<point>;

/// From `from_m` to `to_m` on the east axis, a waypoint every 5 m.
line eastward(double from_m, double to_m) {
  line route;
  for (auto x_m = from_m; x_m < to_m; x_m += 5)
    route.push_back({x_m, 0});
  route.push_back({to_m, 0});
  return route;
}

/// The LODM with r_off = 300 m and d_min = 50 m, the provider at the origin.
bool wants(local_policy& lodm, const line& path, double speed_mps = 10,
           point provider_at = {0, 0}) {
  const std::vector<provider_view> one{{7, provider_at, 0}};
  const auto to =
      goes_to(lodm.decide({time_point{}, "any", one, path, speed_mps}));
  CHECK((!to || *to == 7));
  return to.has_value();
}

bool wants(const line& path, double speed_mps = 10) {
  return wants(*make_lodm("location"), path, speed_mps);
}

/// A street along the east axis, and an area that ends at 100 m.
struct codm_world {
  const polygon area{{{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}};
  const road_map map{
      "street", {}, {{"street", eastward(-500, 500), 1.75, {{0, 14}}, {}, 0}}};
  std::unique_ptr<central_policy> codm = make_codm("location");

  std::vector<central_decision> decide(central_policy& with, const line& route,
                                       double speed_mps,
                                       std::vector<std::string_view> kinds) {
    std::vector<request_view> requests;
    for (const auto kind : kinds)
      requests.push_back({101, kind, route, speed_mps, 0});
    return with.decide({time_point{}, requests, {}, 0, 1, area, map});
  }
  std::vector<central_decision> decide(const line& route, double speed_mps,
                                       std::vector<std::string_view> kinds = {
                                           "any"}) {
    return decide(*codm, route, speed_mps, std::move(kinds));
  }
  bool accepts(const line& route, double speed_mps) {
    return is_accepted(decide(route, speed_mps).front());
  }
};

} // namespace

// -- LODM --------------------------------------------------------------------

TEST_CASE("a path of more than d_min near the provider is worth a request") {
  CHECK(wants(eastward(0, 100)));
}

TEST_CASE("a path of exactly d_min is not enough") {
  CHECK(!wants({{0, 0}, {50, 0}}));
  CHECK(wants({{0, 0}, {50.001, 0}}));
}

TEST_CASE("a path that ends too soon is not worth it") {
  CHECK(!wants(eastward(0, 45)));
  CHECK(!wants({{0, 0}}));
  CHECK(!wants({}));
}

TEST_CASE("a path that leaves the disc too soon is not worth it") {
  CHECK(!wants(eastward(245, 600))); // 50 m to 295, the next is on the rim
  CHECK(wants(eastward(240, 600)));
}

TEST_CASE("a path that begins outside the disc is not worth it, though it "
          "leads inside, unless its next waypoint is inside") {
  CHECK(!wants(eastward(-310, 305)));
  CHECK(!wants(eastward(-305, 305))); // the rim counts as outside
  CHECK(wants(eastward(-304.999, 305)));
}

TEST_CASE("a path that only touches the disc is not worth it") {
  CHECK(!wants({{-100, 300}, {0, 300}, {100, 300}}));
  CHECK(!wants({{0, 300}, {100, 300}, {200, 300}}));
}

TEST_CASE("a path that touches the rim from inside has left the disc") {
  CHECK(!wants({{260, 0}, {300, 0}, {200, 0}}));
  CHECK(wants({{260, 0}, {299.999, 0}, {280, 0}}));
}

TEST_CASE("what a path does outside the disc never counts") {
  // 40 m inside, out, and 40 m inside again
  CHECK(!wants({{259, 0}, {299, 0}, {310, 0}, {299, 0}, {259, 0}}));
}

TEST_CASE("the speed does not matter to the LODM") {
  CHECK(wants(eastward(0, 100), 0));
  CHECK(!wants(eastward(0, 45), 100));
}

TEST_CASE("the way in the disc is that of a literal reference") {
  dice random{11};
  int yes = 0;
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    line path{{random.between(-320, 320), random.between(-320, 320)}};
    const auto heading = random.between(0, 6.28);
    while (path.size() < 40)
      path.push_back(path.back()
                     + 5 * point{std::cos(heading), std::sin(heading)});
    double passed_m = 0; // algorithm 1, line by line
    for (std::size_t i = 1;
         i < path.size() && std::hypot(path[i].x_m, path[i].y_m) < 300; ++i)
      passed_m += 5;
    // Steps of 5 m: exactly 50 m are decided by rounding.
    if (std::abs(passed_m - 50) < 1)
      continue;
    CHECK(wants(path) == (passed_m > 50));
    yes += passed_m > 50;
  }
  CHECK(yes > 200);
  CHECK(yes < 1800);
}

TEST_CASE("the disc and the least way are options") {
  const auto lodm = make_lodm("location");
  test::option_list options;
  options.numbers = {{"radius_m", 100}, {"min_distance_m", 10}};
  lodm->visit_options(options);
  const auto decide = [&](const line& path) { return wants(*lodm, path); };
  CHECK(decide({{0, 0}, {11, 0}}));
  CHECK(!decide({{0, 0}, {10, 0}}));
  CHECK(!decide({{95, 0}, {105, 0}, {115, 0}}));
  CHECK(decide({{85, 0}, {99, 0}, {115, 0}}));
}

TEST_CASE("a provider that is nowhere is not worth a request") {
  const auto lodm = make_lodm("location");
  const auto path = eastward(0, 100);
  CHECK(!wants(*lodm, path, 10, {not_a_number, 0}));
  CHECK(!wants(*lodm, path, 10, {0, not_a_number}));
}

// -- CODM --------------------------------------------------------------------

TEST_CASE_FIXTURE(codm_world, "a vehicle that leaves the area within t_min is "
                              "refused") {
  CHECK(!accepts(eastward(50, 300), 10.001));
}

TEST_CASE_FIXTURE(codm_world, "a vehicle that stays for exactly t_min is "
                              "accepted") {
  CHECK(accepts(eastward(50, 300), 10));
}

TEST_CASE_FIXTURE(codm_world, "a standing vehicle is accepted") {
  CHECK(accepts(eastward(95, 300), 0));
}

TEST_CASE_FIXTURE(codm_world,
                  "a standing vehicle outside the area is refused") {
  CHECK(!accepts(eastward(101, 300), 0));
}

TEST_CASE_FIXTURE(codm_world, "a route that ends inside is accepted when it "
                              "takes long enough") {
  CHECK(accepts(eastward(0, 60), 10));
  CHECK(!accepts(eastward(0, 45), 10));
}

TEST_CASE_FIXTURE(codm_world, "a vehicle that is not in the area yet is "
                              "refused") {
  CHECK(!accepts(eastward(-105, 100), 10));
  CHECK(accepts(eastward(-100, 100), 10));
}

TEST_CASE_FIXTURE(codm_world,
                  "a route that leaves the map anywhere is refused, "
                  "be it by one waypoint") {
  for (const std::size_t k : {0, 3, 20, 59}) {
    auto route = eastward(0, 300);
    REQUIRE(accepts(route, 10));
    route[k].y_m = 2.9;
    CHECK(accepts(route, 10));
    route[k].y_m = 3.1;
    CHECK(!accepts(route, 10));
  }
}

TEST_CASE_FIXTURE(codm_world, "where the provider has no map nobody is "
                              "accepted") {
  const road_map none;
  const auto route = eastward(0, 300);
  const std::vector<request_view> one{{101, "any", route, 10, 0}};
  const auto decided =
      codm->decide({time_point{}, one, {}, 0, 1, area, none}).front();
  CHECK(!is_accepted(decided));
  CHECK(decided.why == "no map present");
}

TEST_CASE_FIXTURE(codm_world, "the route is matched to the map before the area "
                              "is looked at") {
  // Off the map, outside the area and too short, all at once.
  CHECK(decide({{101, 50}, {102, 50}}, 10).front().why
        == "route is not on the map");
  CHECK(decide({{101, 0}, {102, 0}}, 10).front().why == "outside the area");
  CHECK(decide({{98, 0}, {99, 0}}, 10).front().why == "t_in_area < t_min");
}

TEST_CASE_FIXTURE(codm_world, "the decisions tell the number that decided and "
                              "its limit") {
  CHECK(decide({{98, 0}, {99, 0}}, 10).front().why.text()
        == "t_in_area < t_min value_s=0.1 limit_s=5");
  const std::vector<provider_view> one{{7, {0, 0}, 0}};
  const line path{{0, 0}, {12.5, 0}};
  CHECK(make_lodm("location")
            ->decide({time_point{}, "any", one, path, 10})
            .why.text()
        == "path leaves r_off or ends before d_min value_m=12.5 limit_m=50");
}

TEST_CASE_FIXTURE(codm_world, "each reason to refuse has words of its own") {
  const auto why = [&](const line& route, double speed_mps) {
    return decide(route, speed_mps).front().why.text();
  };
  const std::vector<std::string> all{
      why(eastward(50, 300), 20), why(eastward(101, 300), 10),
      why({{0, 50}, {50, 50}}, 1), why(eastward(0, 300), 10)};
  for (std::size_t a = 0; a < all.size(); ++a) {
    CHECK(!all[a].empty());
    for (std::size_t b = 0; b < a; ++b)
      CHECK(all[a] != all[b]);
  }
}

TEST_CASE_FIXTURE(codm_world, "there is a decision for each service") {
  CHECK(decide(eastward(0, 300), 10, {"a", "b", "c"}).size() == 3);
  CHECK(decide(eastward(0, 300), 10, {}).empty());
  for (const auto& d : decide(eastward(101, 300), 10, {"a", "b"}))
    CHECK(!is_accepted(d));
}

TEST_CASE_FIXTURE(codm_world, "the least time and the map's tolerance are "
                              "options") {
  test::option_list options;
  options.times = {{"min_time", 10s}};
  options.numbers = {{"map_tolerance_m", 1}};
  codm->visit_options(options);
  CHECK(!accepts(eastward(50, 300), 10));
  CHECK(accepts(eastward(0, 300), 10));
  CHECK(!accepts({{0, 2}, {100, 2}}, 10));
}

TEST_CASE_FIXTURE(codm_world, "a clone keeps the options") {
  test::option_list options;
  options.times = {{"min_time", 10s}};
  codm->visit_options(options);
  const auto copy = codm->clone();
  const auto route = eastward(50, 300);
  CHECK(!is_accepted(decide(*copy, route, 10, {"any"}).front()));
}

TEST_CASE_FIXTURE(codm_world, "a request full of nonsense is refused") {
  const auto infinity = std::numeric_limits<double>::infinity();
  CHECK(!accepts({}, 10));
  CHECK(!accepts(eastward(0, 300), not_a_number));
  CHECK(!accepts({{not_a_number, 0}, {5, 0}}, 10));
  CHECK(!accepts({{0, 0}, {5, not_a_number}}, 1));
  CHECK(!accepts({{0, 0}, {infinity, 0}}, 1));
  CHECK(!accepts({{0, 0}, {1e300, -1e300}}, 1));
}
