// Time to overtake on the opposite lane.
#include "planners/scene/overtaking.hpp"

#include "planners/scene/corridor.hpp"
#include "planners/scene/opposite_view.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace sofof;
using namespace sofof::planners;

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// 600 m to the east, the other way beside it, 3.5 m wide each.
world::route_ptr street(bool two_ways = true) {
  std::vector<world::lane> lanes(2);
  lanes[0] = {"east", {{0, 0}, {300, 0}, {600, 0}}, 1.75, {{0, 8.33}}, {},
              0,      two_ways ? "west" : ""};
  lanes[1] = {"west",
              {{600, 3.5}, {300, 3.5}, {0, 3.5}},
              1.75,
              {{0, 8.33}},
              {},
              0,
              two_ways ? "east" : ""};
  return std::make_shared<const world::route>(
      "east", lanes, std::vector<std::size_t>{0}, false,
      world::lane_index{{"west", 1}});
}

const auto way = street();
constexpr blocked_stretch truck{200, 206};

/// It stands 14 m before the truck.
overtaking_car waiting(double sees_to_m = unlimited) {
  return {181, 186, 0, sees_to_m, false};
}

bool has_time(const overtaking_car& car,
              const std::vector<oncoming_body>& coming = {}) {
  return has_time_to_overtake(*way, car, truck, coming);
}

track car_at(double x_m, double y_m, double heading_rad, double speed_mps) {
  track x;
  x.motion.mean.col(0) << x_m, y_m;
  x.motion.mean.col(1) << speed_mps * std::cos(heading_rad),
      speed_mps * std::sin(heading_rad);
  x.heading_rad = heading_rad;
  x.length_m = 5;
  x.width_m = 2;
  return x;
}

} // namespace

TEST_CASE("a lane that may be left to the left is as wide as both") {
  CHECK(way->left_m(100) == doctest::Approx(5.25));
  CHECK(way->bounds_at(100).hold(-1.7, 5.2));
  CHECK_FALSE(way->bounds_at(100).hold(-1.8, 0));
  CHECK_FALSE(way->bounds_at(100).hold(0, 5.3));
  CHECK(street(false)->left_m(100) == doctest::Approx(1.75));
}

TEST_CASE("with nobody on the opposite lane there is time to overtake, but not "
          "where there is no such lane, or it ends too soon") {
  CHECK(has_time(waiting()));
  CHECK_FALSE(has_time_to_overtake(*street(false), waiting(), truck, {}));
  CHECK_FALSE(has_time_to_overtake(*way, {561, 566, 0, unlimited, false},
                                   {580, 590}, {}));
}

TEST_CASE("who comes leaves time if it is far away, the more the faster") {
  const auto from_where_m = [](double speed_mps, bool has_begun) {
    auto car = waiting();
    car.has_begun = has_begun;
    for (auto at_m = 210.0; at_m < 600; at_m += 1)
      if (has_time(car, {{at_m, at_m + 5, speed_mps}}))
        return at_m;
    return unlimited;
  };
  const auto slow = from_where_m(5, false), fast = from_where_m(8.33, false);
  CHECK(slow > 240);
  CHECK(fast > slow + 20);
  CHECK(fast < 320);
  CHECK(from_where_m(8.33, true) < fast - 10);
}

TEST_CASE("who has passed, or stands far behind, is no hindrance; who stands "
          "beside is one") {
  CHECK(has_time(waiting(), {{150, 155, 8}}));
  CHECK(has_time(waiting(), {{260, 265, 0}}));
  CHECK_FALSE(has_time(waiting(), {{202, 207, 0}}));
  CHECK_FALSE(has_time(waiting(), {{190, 195, 8}}));
}

TEST_CASE("what is out of sight may come a little above the limit") {
  CHECK_FALSE(has_time(waiting(260)));
  CHECK(has_time(waiting(330)));
  auto begun = waiting(260);
  begun.has_begun = true;
  CHECK(has_time(begun));
}

TEST_CASE("a car at speed needs less time than one that stands") {
  const std::vector<oncoming_body> coming{{300, 305, 8.33}};
  CHECK_FALSE(has_time(waiting(), coming));
  CHECK(has_time({181, 186, 8.33, unlimited, false}, coming));
}

TEST_CASE("on the opposite lane is who reaches into it, as it comes") {
  std::vector<oncoming_body> found;
  const auto look = [&](const track& x) {
    found.clear();
    add_if_opposite(*way, 100, 400, x, found);
    return found.size();
  };
  REQUIRE(look(car_at(300, 3.5, std::numbers::pi, 8)) == 1);
  CHECK(found[0].front_m == doctest::Approx(297.5));
  CHECK(found[0].rear_m == doctest::Approx(302.5));
  CHECK(found[0].speed_mps == doctest::Approx(8));
  CHECK(look(car_at(300, 0, 0, 8)) == 0);
  CHECK(look(car_at(300, 7.5, std::numbers::pi, 8)) == 0);
  CHECK(look(car_at(450, 3.5, std::numbers::pi, 8)) == 0);
  REQUIRE(look(car_at(300, 2, std::numbers::pi / 2, 3)) == 1); // it crosses
  CHECK(found[0].speed_mps == 0);
}

TEST_CASE(
    "of the opposite lane less is seen past a body, the nearer the less") {
  const oriented_box body{{203, 0}, 0, 6, 2.2};
  const auto sees_m = [&](double from_m, double d_m, double range_m) {
    return opposite_in_sight_m(*way, {from_m, d_m}, 200, range_m, nullptr,
                               body);
  };
  CHECK(sees_m(120, 0, 130) == doctest::Approx(248).epsilon(0.02)); // its range
  CHECK(sees_m(190, 0, 130) < 250);
  CHECK(sees_m(180, 0, 130) > sees_m(190, 0, 130));
  CHECK(sees_m(190, 1.2, 130) > 310);
}

TEST_CASE("a car that waits behind a body stands so far left that it sees past "
          "it, and leaves room for who comes") {
  constexpr world::vehicle_params car;
  constexpr double rests_m = 190, half_lane_m = 1.75;
  CHECK_FALSE(look_past(-0.2, rests_m, half_lane_m, car)); // it sees past it
  for (const auto body_left_m : {0.2, 0.5, 0.8, 1.2, 1.75}) {
    CAPTURE(body_left_m);
    const auto keeps = look_past(body_left_m, rests_m, half_lane_m, car);
    REQUIRE(keeps);
    // The car's middle is as far from what keeps it as from any body.
    const auto middle_m =
        keeps->high_m + corridor::room_beside_m - car.width_m / 2;
    const auto left_side_m = middle_m + car.width_m / 2;
    CHECK(middle_m <= body_left_m + 0.1 + 1e-9);
    CHECK(left_side_m <= half_lane_m + 0.25 + 1e-9);
    CHECK((middle_m > body_left_m || left_side_m > half_lane_m + 0.2));
    CHECK(half_lane_m + keeps->left_m - keeps->high_m
          > corridor::room_beside_m); // it can be passed, on the left
    CHECK(keeps->from_m < rests_m - car.front_m); // its axle is there, too
  }
}
