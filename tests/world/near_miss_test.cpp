// Tests of time to collision and of near misses.
#include "world/traffic/near_miss.hpp"

#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

using namespace sofof;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr double east = 0, north = std::numbers::pi / 2,
                 west = std::numbers::pi;

road_body driving_car(station_id id, point at, double heading_rad,
                      double speed_mps) {
  return {id, {at, heading_rad, 5, 2}, speed_mps, 0};
}

/// @returns where a body is after a while.
oriented_box box_after(const road_body& x, double t_s) {
  auto box = x.box;
  box.centre =
      box.centre
      + t_s * x.speed_mps
            * point{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  return box;
}

route_ptr one_lane(std::vector<point> centre) {
  lane l;
  l.name = "lane";
  l.centre = std::move(centre);
  l.half_width_m = 1.75;
  l.limits = {{0, 20}};
  return std::make_shared<const route>(
      "lane", std::vector{l}, std::vector<std::size_t>{0}, false, lane_index{});
}

/// 100 m straight on, a quarter of a circle to the left, 100 m.
/// @param radius_m  Of the bend round (0, 0).
/// @param reverse   Driven the other way round.
route_ptr lane_with_bend(double radius_m, bool reverse) {
  std::vector<point> centre;
  for (auto y_m = -100.0; y_m < -1; y_m += 4)
    centre.push_back({radius_m, y_m});
  constexpr auto pieces = 12;
  for (auto k = 0; k <= pieces; ++k) {
    const auto turn_rad = k * std::numbers::pi / 2 / pieces;
    centre.push_back(radius_m * point{std::cos(turn_rad), std::sin(turn_rad)});
  }
  for (auto x_m = -4.0; x_m >= -100; x_m -= 4)
    centre.push_back({x_m, radius_m});
  if (reverse)
    std::ranges::reverse(centre);
  return one_lane(std::move(centre));
}

/// A car of 5 m on a lane.
/// @param off_m    Beside the lane's centre, left positive.
/// @param off_rad  From the lane's heading.
road_user user_on(station_id id, const route_ptr& on, double s_m,
                  double speed_mps, double off_m = 0, double off_rad = 0) {
  road_user x;
  x.station = id;
  x.on = on;
  x.s_m = s_m;
  x.speed_mps = speed_mps;
  x.front_m = 4;
  x.rear_m = 1;
  const auto lane = on->path().frame(s_m);
  const auto heading_rad = lane.heading_rad + off_rad;
  x.body = {lane.at + off_m * point{-lane.tangent.y_m, lane.tangent.x_m}
                + 1.5 * point{std::cos(heading_rad), std::sin(heading_rad)},
            heading_rad, 5, 2};
  return x;
}

road_body body_of(const road_user& x) {
  return {x.station, x.body, x.speed_mps, 0};
}

/// Two lanes 3.5 m apart through a bend, a car on each, and they meet in it.
struct two_way_bend {
  static constexpr double inner_m = 14, outer_m = 17.5, speed_mps = 9;
  route_ptr left = lane_with_bend(outer_m, false);
  route_ptr back = lane_with_bend(inner_m, true);

  /// @param t_s  Before they are abreast.
  road_user there(double t_s, double off_m = 0) const {
    return user_on(1, left, middle_m(*left) - speed_mps * t_s, speed_mps,
                   off_m);
  }
  road_user oncoming(double t_s) const {
    return user_on(2, back, middle_m(*back) - speed_mps * t_s, speed_mps);
  }
  static double middle_m(const route& of) { return of.length_m() / 2; }
};

struct watch_world {
  near_miss_watch watch;
  time_point now{1h};
  route_ptr street = one_lane({{0, 0}, {50, 0}, {100, 0}, {200, 0}});

  std::size_t look(const std::vector<road_user>& users, duration passed) {
    now += passed;
    return watch.look(users, now).size();
  }
};

} // namespace

TEST_CASE("who catches up touches when the gap is used up") {
  const auto behind = driving_car(1, {0, 0}, east, 15),
             ahead = driving_car(2, {25, 0}, east, 5);
  CHECK(time_to_collision_s(behind, ahead).value() == near(2, 1e-12));
  CHECK(time_to_collision_s(ahead, behind).value() == near(2, 1e-12));
}

TEST_CASE("who falls behind, or keeps his distance, never touches") {
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 5),
                             driving_car(2, {25, 0}, east, 15)));
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 5),
                             driving_car(2, {25, 0}, east, 5)));
}

TEST_CASE("oncoming cars in lanes of their own pass") {
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 15),
                             driving_car(2, {30, 3.5}, west, 15)));
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 15),
                            driving_car(2, {30, 1.5}, west, 15))
            .value()
        == near(25.0 / 30, 1e-12));
}

TEST_CASE("at a crossing it matters who is there when") {
  // Fronts reach the other's side after 2 s.
  CHECK(time_to_collision_s(driving_car(1, {-23.5, 0}, east, 10),
                            driving_car(2, {0, -23.5}, north, 10))
            .value()
        == near(2, 1e-12));
  CHECK(!time_to_collision_s(driving_car(1, {-23.5, 0}, east, 10),
                             driving_car(2, {0, -23.5}, north, 30)));
}

TEST_CASE("bodies that touch have no time left") {
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 0),
                            driving_car(2, {4, 0}, east, 0))
        == 0);
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 3),
                            driving_car(2, {4, 1}, west, 3))
        == 0);
}

TEST_CASE("at the time to collision bodies touch, and not before") {
  dice d{7};
  auto found = 0;
  for (auto k = 0; k < 3'000; ++k) {
    const auto any = [&d](station_id id) {
      return driving_car(id, {d.between(-30, 30), d.between(-30, 30)},
                         d.between(-4, 4), d.between(0, 20));
    };
    const auto a = any(1), b = any(2);
    const auto t_s = time_to_collision_s(a, b);
    if (!t_s) {
      for (auto s = 0.0; s < 10; s += 0.05)
        REQUIRE(!overlap(box_after(a, s), box_after(b, s)));
      continue;
    }
    ++found;
    constexpr auto moment_s = 1e-6;
    REQUIRE(
        overlap(box_after(a, *t_s + moment_s), box_after(b, *t_s + moment_s)));
    for (auto s = 0.0; s < *t_s - moment_s; s += 0.05)
      REQUIRE(!overlap(box_after(a, s), box_after(b, s)));
  }
  CHECK(found > 100);
}

TEST_CASE_FIXTURE(two_way_bend,
                  "oncoming cars that keep their lanes in a bend pass") {
  auto straight_on = 0;
  for (auto t_s = 3.0; t_s > -1; t_s -= 0.05) {
    CAPTURE(t_s);
    const auto one = there(t_s), other = oncoming(t_s);
    CHECK(!time_to_collision_s(one, other));
    const auto aimed = time_to_collision_s(body_of(one), body_of(other));
    straight_on += aimed && *aimed < near_miss_s;
  }
  CHECK(straight_on > 5); // what a rule without lanes would make of it
}

TEST_CASE_FIXTURE(two_way_bend,
                  "who cuts a bend on the other's lane does not") {
  const auto found = time_to_collision_s(there(1, 2.5), oncoming(1));
  REQUIRE(found);
  CHECK(*found < 1);
  CHECK(*found > 0.5);
}

TEST_CASE_FIXTURE(two_way_bend, "who catches up in a bend is seen there too") {
  const auto s_m = middle_m(*left) - 6;
  // As long as the gap lasts at 8 m/s; a bend is shorter for its bumpers.
  const auto found = time_to_collision_s(user_on(1, left, s_m, 12),
                                         user_on(2, left, s_m + 13, 4));
  REQUIRE(found);
  CHECK(*found == near(1, 0.1));
}

TEST_CASE("on straight lanes only the drift across them matters") {
  const auto east_lane = one_lane({{0, 0}, {100, 0}, {200, 0}});
  const auto west_lane = one_lane({{200, 3.5}, {100, 3.5}, {0, 3.5}});
  dice d{11};
  auto found = 0;
  for (auto k = 0; k < 2'000; ++k) {
    const auto one = user_on(1, east_lane, d.between(80, 110), d.between(0, 20),
                             d.between(-2, 2), d.between(-0.3, 0.3)),
               other =
                   user_on(2, west_lane, d.between(60, 110), d.between(0, 20),
                           d.between(-2, 2), d.between(-0.3, 0.3));
    const auto straight_s = time_to_collision_s(body_of(one), body_of(other));
    const auto lane_s = time_to_collision_s(one, other);
    if (straight_s && *straight_s < near_miss_s - 1e-9) {
      ++found;
      REQUIRE(lane_s);
      REQUIRE(std::abs(*lane_s - *straight_s) < 1e-6);
    } else if (!straight_s || *straight_s > near_miss_s + 1e-9) {
      REQUIRE(!lane_s);
    }
  }
  CHECK(found > 100);
}

TEST_CASE("at a lane's begin its first metre counts like others") {
  const auto lane = one_lane({{0, 0}, {50, 0}, {100, 0}});
  for (const auto from_m : {0.0, 0.5})
    CHECK(time_to_collision_s(user_on(1, lane, from_m, 20),
                              user_on(2, lane, from_m + 15, 10))
              .value()
          == near(1, 1e-6));
}

TEST_CASE("a lane goes straight on beyond its end") {
  const auto lane = one_lane({{0, 0}, {50, 0}, {100, 0}});
  CHECK(time_to_collision_s(user_on(1, lane, 84, 20), user_on(2, lane, 99, 10))
            .value()
        == near(1, 1e-6));
}

TEST_CASE_FIXTURE(watch_world, "an encounter is a near miss once") {
  const auto at = [this](double gap_m) {
    return std::vector{user_on(7, street, gap_m + 25, 0),
                       user_on(3, street, 20, 10)};
  };
  CHECK(look(at(15.1), 50ms) == 0); // 1.51 s
  const auto& begun = watch.look(at(14.9), now += 50ms);
  REQUIRE(begun.size() == 1);
  CHECK(begun[0].first == 3);
  CHECK(begun[0].second == 7);
  CHECK(begun[0].time_to_collision_s == near(1.49, 1e-6));
  CHECK(look(at(14), 50ms) == 0);
  CHECK(look(at(16), 50ms) == 0); // brakes
  CHECK(look(at(14), 1s) == 0);   // and comes again
  CHECK(look(at(16), 50ms) == 0);
  CHECK(look(at(14), same_encounter + 50ms) == 1);
}

TEST_CASE_FIXTURE(watch_world, "of many, those that come near are found") {
  std::vector<road_user> all;
  std::vector<route_ptr> streets;
  for (const auto y_m : {0.0, 40.0, 80.0})
    streets.push_back(
        one_lane({{-200, y_m}, {0, y_m}, {1000, y_m}, {2200, y_m}}));
  for (station_id::rep k = 0; k < 20; ++k) { // each fifth is caught up with
    const auto& on = streets[k % 3];
    const auto s_m = 200 + 100.0 * static_cast<double>(k);
    all.push_back(user_on(2 * k + 2, on, s_m, 10));
    all.push_back(user_on(2 * k + 1, on, s_m - (k % 5 == 0 ? 12 : 60), 20));
  }
  const auto begun = watch.look(all, now);
  REQUIRE(begun.size() == 4);
  for (std::size_t i = 0; i < begun.size(); ++i) {
    CHECK(begun[i].first == 10 * i + 1);
    CHECK(begun[i].second == 10 * i + 2);
  }
}
