// Which route somebody follows who only tells its waypoints.
#include "world/roads/route_finder.hpp"

#include "tests/support/toy_streets.hpp"
#include "tests/world/lehr.hpp"
#include "world/roads/street_grid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace sofof;
using namespace sofof::world;
using test::lehr;

namespace {

/// As they are after the way over the air: on whole centimetres.
std::vector<point> told(const route& way, double s_m, double ahead_m = 200,
                        double spacing_m = 10) {
  auto points = way.waypoints(s_m, ahead_m, spacing_m);
  for (auto& p : points)
    p = {std::round(100 * p.x_m) / 100, std::round(100 * p.y_m) / 100};
  return points;
}

std::optional<found_route> find(const std::vector<point>& waypoints) {
  return find_route(lehr().routes, waypoints);
}

/// The farthest that waypoints are from where they are said to be.
double miss_m(const found_route& found, const std::vector<point>& waypoints) {
  const auto& line = found.way->path();
  auto worst_m =
      std::max(distance_m(line.at(found.ahead.from_m).at, waypoints.front()),
               distance_m(line.at(found.ahead.to_m).at, waypoints.back()));
  for (const auto p : waypoints)
    worst_m = std::max(worst_m, std::abs(line.project(p).d_m));
  return worst_m;
}

/// Half of it on the way there, and back beside it; a tight loop at the end.
route_ptr hairpin() {
  std::vector<lane> lanes(1);
  lanes[0].name = "hairpin";
  lanes[0].limits = {{0, 10}};
  for (auto x = 0.0; x < 100; x += 5)
    lanes[0].centre.push_back({x, -7});
  for (auto a = -0.5; a < 0.5; a += 0.1)
    lanes[0].centre.push_back({100 + 7 * std::cos(a * std::numbers::pi),
                               7 * std::sin(a * std::numbers::pi)});
  for (auto x = 100.0; x >= 0; x -= 5)
    lanes[0].centre.push_back({x, 7});
  return std::make_shared<const route>(
      "hairpin", lanes, std::vector<std::size_t>{0}, false, lane_index{});
}

} // namespace

TEST_CASE("every route of Ulm-Lehr is found from everywhere on it") {
  for (const auto& way : lehr().routes)
    for (const auto spacing_m : {10.0, 20.0})
      for (auto s_m = 0.3; s_m < way->length_m() - 5; s_m += 7.7) {
        const auto waypoints = told(*way, s_m, 200, spacing_m);
        const auto found = find(waypoints);
        CAPTURE(way->name());
        CAPTURE(s_m);
        REQUIRE(found);
        CHECK(miss_m(*found, waypoints) < 0.1);
        const auto ahead_m =
            way->closed() ? 200 : std::min(200.0, way->length_m() - s_m);
        CHECK(std::abs(found->ahead.to_m - found->ahead.from_m - ahead_m) < 1);
        const auto there = found->way->path().at(found->ahead.from_m);
        CHECK(std::cos(there.heading_rad - way->path().at(s_m).heading_rad)
              > 0.999);
      }
}

TEST_CASE("where only one route runs it is found to the centimetre") {
  for (const auto& way : lehr().routes)
    for (auto s_m = 0.3; s_m < way->length_m() - 5; s_m += 31) {
      const auto found = find_route({&way, 1}, told(*way, s_m));
      REQUIRE(found);
      CHECK(found->way == way);
      CHECK(std::abs(found->ahead.from_m - s_m) < 0.01);
    }
}

TEST_CASE("of routes that are alike as far as is told the first is found") {
  const auto map = toy::cross_roads();
  const std::vector routes{toy::make_route(map, {3, 0, 2}),
                           toy::make_route(map, {3, 0, 1}),
                           toy::make_route(map, {3, 0, 4})};
  const auto far = find_route(routes, told(*routes[2], 20, 200));
  REQUIRE(far);
  CHECK(far->way == routes[2]);
  const auto near = find_route(routes, told(*routes[2], 20, 80));
  REQUIRE(near);
  CHECK(near->way == routes[0]);
}

TEST_CASE("who drives the other way follows another route") {
  const auto map = toy::cross_roads();
  const std::vector routes{toy::make_route(map, {3, 0, 1}),
                           toy::make_route(map, {1, 0, 3})};
  const auto back = find_route(routes, told(*routes[1], 50, 150));
  REQUIRE(back);
  CHECK(back->way == routes[1]);
}

TEST_CASE("waypoints in reverse order are on no route") {
  for (const auto& way : lehr().routes)
    for (auto s_m = 0.3; s_m < way->length_m() - 20; s_m += 31) {
      auto waypoints = told(*way, s_m);
      std::ranges::reverse(waypoints);
      CHECK_FALSE(find(waypoints));
      CHECK_FALSE(still_on(*way, s_m, waypoints));
    }
}

TEST_CASE("waypoints beside the lane, or that leave it, are on no route") {
  const auto& way = *lehr().route("round_trip");
  auto beside = told(way, 100);
  for (auto& p : beside)
    p = p + point{1.0, 1.0};
  CHECK_FALSE(find(beside));
  auto leaves = told(way, 100);
  leaves.back() = leaves.back() + point{1.0, 1.0};
  CHECK_FALSE(find(leaves));
}

TEST_CASE("waypoints of a slightly different map are found all the same") {
  const auto& way = *lehr().route("round_trip_opposite");
  auto shifted = told(way, 100);
  for (auto& p : shifted)
    p = p + point{0.3, -0.3};
  const auto found = find(shifted);
  REQUIRE(found);
  CHECK(miss_m(*found, shifted) < 0.5);
}

TEST_CASE("waypoints left out or taken twice are another way") {
  const auto way = hairpin();
  auto waypoints = told(*way, 60, 100, 10);
  REQUIRE(still_on(*way, 60, waypoints));
  // Straight from the way there to the way back.
  waypoints.erase(waypoints.begin() + 1, waypoints.end() - 2);
  CHECK_FALSE(find_route({&way, 1}, waypoints));
  auto twice = told(*way, 20, 50, 10);
  std::swap(twice[2], twice[3]);
  CHECK_FALSE(find_route({&way, 1}, twice));
}

TEST_CASE("a route that passes beside itself is told from there and back") {
  const auto way = hairpin();
  for (auto s_m = 0.0; s_m < way->length_m() - 10; s_m += 3) {
    const auto found = find_route({&way, 1}, told(*way, s_m, 60, 20));
    REQUIRE(found);
    CHECK(std::abs(found->ahead.from_m - s_m) < 0.01);
  }
}

TEST_CASE("a closed route goes on over its seam") {
  const auto way = lehr().route("round_trip");
  const auto lap_m = way->length_m();
  for (const auto before_m : {0.001, 5.0, 100.0, 199.0}) {
    const auto waypoints = told(*way, lap_m - before_m);
    const auto found = find_route({&way, 1}, waypoints);
    REQUIRE(found);
    CHECK(found->ahead.from_m >= 0);
    CHECK(found->ahead.from_m < lap_m);
    CHECK(std::abs(found->ahead.to_m - found->ahead.from_m - 200) < 0.02);
    const auto later = still_on(*way, 4 * lap_m - before_m + 10, waypoints);
    REQUIRE(later);
    CHECK(std::abs(later->from_m - (4 * lap_m - before_m)) < 0.01);
    CHECK(std::abs(later->to_m - (4 * lap_m - before_m + 200)) < 0.01);
  }
}

TEST_CASE("who is still on its route is found from a guess") {
  for (const auto& way : lehr().routes)
    for (auto s_m = 30.0; s_m < way->length_m() - 5; s_m += 31)
      for (const auto off_m : {-15.0, 0.0, 15.0}) {
        const auto ahead = still_on(*way, s_m + off_m, told(*way, s_m));
        REQUIRE(ahead);
        CHECK(std::abs(ahead->from_m - s_m) < 0.01);
      }
}

TEST_CASE("who has left its route is not still on it") {
  const auto map = toy::cross_roads();
  const auto left = toy::make_route(map, {3, 0, 2});
  const auto right = toy::make_route(map, {3, 0, 4});
  CHECK(still_on(*left, 80, told(*right, 80, 40)));
  CHECK_FALSE(still_on(*left, 80, told(*right, 80, 80)));
  CHECK_FALSE(still_on(*left, 40, told(*left, 100, 80))); // a bad guess
}

TEST_CASE("what is no way is on no route") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  const auto& way = *lehr().route("round_trip");
  const auto here = way.path().at(100).at;
  CHECK_FALSE(find({}));
  CHECK_FALSE(find({here}));
  CHECK_FALSE(find({here, here, here, here}));
  CHECK_FALSE(find(told(way, 100, 0.5, 0.1)));
  for (const auto wrong :
       {nan, std::numeric_limits<double>::infinity(), 1e300, -1e9}) {
    auto waypoints = told(way, 100);
    waypoints[7].x_m = wrong;
    CHECK_FALSE(find(waypoints));
    CHECK_FALSE(still_on(way, 100, waypoints));
    waypoints[0].y_m = wrong;
    CHECK_FALSE(find(waypoints));
  }
  CHECK_FALSE(still_on(way, nan, told(way, 100)));
  CHECK_FALSE(find_route({}, told(way, 100)));
}

TEST_CASE("a short way to the end of a route is found, and the end with it") {
  const auto way = lehr().route("west_to_east");
  const auto end_m = way->length_m();
  for (const auto left_m : {40.001, 20.0, 3.0, 1.2}) {
    const auto found =
        find_route({&way, 1}, told(*way, end_m - left_m, 200, 20));
    REQUIRE(found);
    CHECK(std::abs(found->ahead.from_m - (end_m - left_m)) < 0.02);
    CHECK(std::abs(found->ahead.to_m - end_m) < 0.02);
  }
}

TEST_CASE("every way through the town is found among hundreds") {
  const auto town = make_street_grid({});
  REQUIRE(town->routes.size() > 200);
  for (std::size_t i = 0; i < town->routes.size(); i += 7) {
    const auto& way = town->routes[i];
    const auto s_m = 0.37 * way->length_m();
    const auto waypoints = told(*way, s_m, 200, 15);
    const auto found = find_route(town->routes, waypoints);
    REQUIRE(found);
    CHECK(miss_m(*found, waypoints) < 0.5);
    CHECK(std::abs(found->ahead.to_m - found->ahead.from_m - 200) < 1);
  }
}
