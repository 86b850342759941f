// How far a route is seen, and round which corners.
#include "planners/scene/route_sight.hpp"

#include "planners/speed/sight_limit.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace sofof;
using namespace sofof::planners;

namespace {

/// A house from its south-western corner on.
world::building house(double x_m, double y_m, double east_m, double north_m) {
  return {{{x_m, y_m},
           {x_m + east_m, y_m},
           {x_m + east_m, y_m + north_m},
           {x_m, y_m + north_m}}};
}

const world::road_map& cross() {
  static const auto map = toy::cross_roads();
  return map;
}

const lane_network& lanes() {
  static const lane_network all{cross()};
  return all;
}

/// At each corner of the crossing, so far from both of its streets' middles.
std::vector<world::building> houses_at(double corner_m) {
  std::vector<world::building> all;
  for (const auto x : {-corner_m - 40, corner_m})
    for (const auto y : {-corner_m - 40, corner_m})
      all.push_back(house(x, y, 40, 40));
  return all;
}

/// What is seen from south to north, which gives way.
struct view {
  view(double corner_m, const eyes_on_road& eyes)
      : houses{houses_at(corner_m)}, way{toy::make_route(cross(), {4, 0, 2})},
        sight{way, houses, eyes} {}

  line_of_sight houses;
  world::route_ptr way;
  route_sight sight;
};

} // namespace

TEST_CASE("a straight way is seen as far as sensors reach") {
  const view free{200, {.range_m = 60}};
  // From the middle of the body, 2.55 m behind the front.
  CHECK(free.sight.ahead_m(20) == doctest::Approx(57.45).epsilon(0.05));
  const view far{200, {.range_m = 1000}};
  CHECK(far.sight.ahead_m(20) >= 200); // to its end
}

TEST_CASE(
    "a corner of an open place is seen round from everywhere, one between "
    "houses from the line on, or never") {
  const eyes_on_road eyes{};
  CHECK(view{200, eyes}.sight.corners(lanes()).empty());
  const auto near = view{15, eyes}.sight.corners(lanes());
  REQUIRE_FALSE(near.empty());
  CHECK(near[0].seen_from_m < near[0].line_m);
  CHECK(near[0].seen_from_m > near[0].line_m - 30);
  const auto tight = view{4, eyes}.sight.corners(lanes());
  REQUIRE_FALSE(tight.empty());
  CHECK(tight[0].seen_from_m > near[0].seen_from_m);
}

TEST_CASE("a sensor at the roadside sees round corners") {
  eyes_on_road eyes;
  eyes.roadside = {{{0, 0}, 0, 120, 360}};
  CHECK(view{5, eyes}.sight.corners(lanes()).empty());
}

TEST_CASE("a sensor at the roadside sees farther along a way than the car") {
  eyes_on_road eyes;
  eyes.range_m = 30;
  CHECK(view{200, eyes}.sight.ahead_m(20) < 30);
  eyes.roadside = {{{0, 0}, 0, 120, 360}};
  CHECK(view{200, eyes}.sight.ahead_m(40) > 100);
}

TEST_CASE("who has the right of way by rank has no blind corners") {
  const line_of_sight houses{houses_at(5)};
  const auto way = toy::make_route(cross(), {3, 0, 1});
  CHECK(route_sight(way, houses, {}).corners(lanes()).empty());
}

TEST_CASE("a car can stop within what it sees, firmly") {
  const comfort_limits style;
  for (const double range_m : {15, 25, 40}) {
    const view near{200, {.range_m = range_m}};
    const auto most_mps =
        sight_limits_mps(*near.way, style, near.sight, nullptr);
    const auto v = most_mps[60];
    const auto free_m = range_m - 2.55 - 2.55; // to the nearest car's rear
    CHECK(v * v / (2 * style.firm_decel_mps2()) < free_m);
    CHECK(v > 0.7 * std::sqrt(2 * style.firm_decel_mps2() * (free_m - 3)));
  }
}

TEST_CASE("before a blind corner a car can stop, and behind it drives on") {
  const comfort_limits style;
  const view tight{5, {}};
  const auto corners = tight.sight.corners(lanes());
  REQUIRE_FALSE(corners.empty());
  const auto plain = sight_limits_mps(*tight.way, style, tight.sight, nullptr);
  const auto careful =
      sight_limits_mps(*tight.way, style, tight.sight, &lanes());
  const auto line_m = corners[0].line_m;
  const auto at = [](double s_m) { return static_cast<std::size_t>(s_m); };
  for (auto s = line_m - 60; s < corners[0].seen_from_m; ++s) {
    const auto v = careful[at(s)];
    CHECK((v * v / (2 * style.firm_decel_mps2()) < line_m - s || v <= 2.6));
  }
  CHECK(careful[at(line_m - 10)] < plain[at(line_m - 10)] - 1);
  CHECK(careful[at(line_m + 80)] == plain[at(line_m + 80)]);
}
