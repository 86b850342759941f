// Where a vehicle is that is planned for from afar.
#include "planners/scene/ego_estimator.hpp"

#include "planners/scene/lane_motion.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "tests/planners/test_drive.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using namespace std::chrono_literals;
using doctest::Approx;

namespace {

constexpr time_point departure{50s};

/// Eastwards for 6 s, with constant acceleration down to rest.
trajectory plan_east(time_point from, double s_m, double speed_mps,
                     double accel_mps2 = 0, double d_m = 0) {
  trajectory t{from, {}};
  lane_motion x{s_m, speed_mps, accel_mps2};
  for (auto i = 0; i <= 60; ++i) {
    t.points.push_back(
        {0.1 * i, x.s_m, {x.s_m, d_m}, 0, 0, x.speed_mps, x.accel_mps2});
    x = advance(x, x.accel_mps2, 0.1);
  }
  return t;
}

reported_state told_east(time_point at, double s_m, double speed_mps,
                         double d_m = 0) {
  return {at, {s_m, d_m}, 0, speed_mps, 0, 0};
}

const auto& straight_street() {
  static const auto way = test::straight(500, {{0, 20}});
  return way;
}

} // namespace

TEST_CASE("who was not heard is nowhere") {
  ego_estimator me{straight_street(), 0};
  me.follow(plan_east(departure, 0, 10));
  CHECK_FALSE(me.at(departure + 100ms));
}

TEST_CASE("without a plan a vehicle goes on at constant acceleration") {
  ego_estimator me{straight_street(), 90};
  auto told = told_east(departure, 100, 10, 0.3);
  told.accel_mps2 = 2;
  me.on_report(told);
  const auto x = me.at(departure + 1s);
  REQUIRE(x);
  CHECK(x->at == departure + 1s);
  CHECK(x->s_m == Approx(111));
  CHECK(x->d_m == Approx(0.3));
  CHECK(x->speed_mps == Approx(12));
  CHECK(x->accel_mps2 == Approx(2));
}

TEST_CASE("a vehicle that brakes comes to rest, and does not back up") {
  ego_estimator me{straight_street(), 100};
  auto told = told_east(departure, 100, 2);
  told.accel_mps2 = -4;
  me.on_report(told);
  for (const auto age : {500ms, 1000ms, 1100ms}) {
    const auto x = *me.at(departure + age);
    CHECK(x.s_m == Approx(100.5));
    CHECK(x.speed_mps == 0);
    CHECK(x.accel_mps2 == 0);
  }
}

TEST_CASE("a vehicle in a bend goes on along the bend, as bent as it was") {
  const auto way = test::oval({{0, 20}});
  const auto s_m = 280.0; // before the first corner
  const auto here = way->path().at(s_m);
  ego_estimator me{way, s_m};
  me.on_report(
      {departure, here.at, here.heading_rad, 10, 0, here.curvature_1pm});
  const auto x = *me.at(departure + 1500ms); // in it
  CHECK(x.s_m == Approx(295));
  CHECK(std::abs(x.d_m) < 1e-3);
  CHECK(std::abs(x.heading_error_rad) < 1e-3);
  CHECK(x.curvature_1pm == Approx(way->path().at(295).curvature_1pm));
  CHECK(x.curvature_1pm > 0.05);
}

TEST_CASE("on a closed route laps count on") {
  const auto way = test::oval({{0, 20}});
  const auto lap_m = way->length_m();
  const auto s_m = 3 * lap_m - 2;
  const auto at = [&](double s) {
    const auto p = way->path().at(s);
    return std::pair{p.at, p.heading_rad};
  };
  ego_estimator me{way, s_m - 5};
  auto [place, heading] = at(s_m);
  me.on_report({departure, place, heading, 10, 0, 0});
  CHECK(me.at(departure)->s_m == Approx(s_m));
  std::tie(place, heading) = at(s_m + 10);
  me.on_report({departure + 1s, place, heading, 10, 0, 0});
  CHECK(me.at(departure + 1s)->s_m == Approx(s_m + 10));
  CHECK(std::abs(me.at(departure + 1s)->heading_error_rad) < 1e-6);
}

TEST_CASE("a vehicle is off its plan now what it was off when it told") {
  ego_estimator me{straight_street(), 100};
  const auto plan = plan_east(departure, 100, 10, -2, 0.1);
  me.follow(plan);
  auto told = told_east(departure, 100.4, 10.3, 0.15);
  told.heading_rad = 0.01;
  told.accel_mps2 = 3; // a kick that the plan knows nothing of
  me.on_report(told);
  const auto x = *me.at(departure + 1s);
  CHECK(x.s_m == Approx(109.4));
  CHECK(x.d_m == Approx(0.15));
  CHECK(x.heading_error_rad == Approx(0.01));
  CHECK(x.speed_mps == Approx(8.3));
  CHECK(x.accel_mps2 == Approx(-2));
}

TEST_CASE("a plan that was followed is gone on from though the vehicle told "
          "of itself a second ago") {
  ego_estimator me{straight_street(), 100};
  const auto plan = plan_east(departure, 100, 10, -3);
  me.follow(plan);
  me.on_report(told_east(departure, 100.4, 10));
  const auto now = departure + 1100ms;
  const auto from = joined(*straight_street(), now, *me.at(now), &plan);
  CHECK(from.s_m == Approx(plan.at(now).s_m));
  CHECK(from.speed_mps == Approx(plan.at(now).speed_mps));
}

TEST_CASE("a plan that is not followed is not gone on from") {
  ego_estimator me{straight_street(), 100};
  const auto plan = plan_east(departure, 100, 10);
  me.follow(plan);
  const auto now = departure + 500ms;
  me.on_report(told_east(departure, 102, 10)); // 2 m ahead: on, as planned
  CHECK(joined(*straight_street(), now, *me.at(now), &plan).s_m == Approx(107));
  me.on_report(told_east(departure + 100ms, 100, 0)); // has not set off
  CHECK(joined(*straight_street(), now, *me.at(now), &plan).s_m == Approx(100));
  CHECK(joined(*straight_street(), now, *me.at(now), &plan).speed_mps == 0);
  me.on_report(
      told_east(departure + 200ms, 120, 10)); // something else altogether
  CHECK(me.at(now)->s_m == Approx(123));
}

TEST_CASE("plans that follow each other are one motion") {
  ego_estimator me{straight_street(), 100};
  me.on_report(told_east(departure, 100.2, 10));
  lane_motion planned{100, 10, 0}, then;
  auto now = departure;
  for (auto i = 0; i < 20; ++i, now += 50ms) { // each brakes harder
    const auto plan = plan_east(now, planned.s_m, planned.speed_mps, -0.2 * i);
    me.follow(plan);
    if (i == 10)
      then = planned;
    const auto end = plan.at(now + 50ms);
    planned = {end.s_m, end.speed_mps, 0};
  }
  CHECK(me.at(now)->s_m == Approx(planned.s_m + 0.2));
  CHECK(me.at(now)->speed_mps == Approx(planned.speed_mps));
  // What is told of an earlier time is held against the plan of that time.
  me.on_report(told_east(now - 500ms, then.s_m - 0.3, then.speed_mps + 0.1));
  CHECK(me.at(now)->s_m == Approx(planned.s_m - 0.3));
  CHECK(me.at(now)->speed_mps == Approx(planned.speed_mps + 0.1));
}

TEST_CASE("what was told between two plans is held against both") {
  ego_estimator me{straight_street(), 100};
  const auto first = plan_east(departure, 100, 10, 2);
  me.follow(first);
  const auto then = first.at(departure + 200ms);
  me.follow(plan_east(departure + 200ms, then.s_m, then.speed_mps, 0));
  const auto mid = first.at(departure + 70ms);
  me.on_report(told_east(departure + 70ms, mid.s_m, mid.speed_mps));
  CHECK(std::abs(me.at(departure + 200ms)->s_m - then.s_m) < 1e-9);
  CHECK(std::abs(me.at(departure + 200ms)->speed_mps - then.speed_mps) < 1e-9);
}

TEST_CASE("a plan that begins at the vehicle leaves nothing to be off") {
  ego_estimator me{straight_street(), 100};
  me.follow(plan_east(departure, 100, 10));
  me.on_report(told_east(departure, 103, 10.5, 0.4));
  auto now = departure + 100ms;
  const auto from = *me.at(now);
  CHECK(from.s_m == Approx(104));
  // 3 m are too far to join: the next plan begins where the vehicle is.
  me.follow(plan_east(now, from.s_m, from.speed_mps, 0, 0.4));
  for (auto i = 0; i < 5; ++i, now += 100ms) {
    const auto x = *me.at(now);
    CHECK(x.s_m == Approx(104 + 1.05 * i));
    CHECK(x.d_m == Approx(0.4));
    CHECK(x.speed_mps == Approx(10.5));
    CHECK(x.heading_error_rad == Approx(0));
  }
}

TEST_CASE("what was told before all plans is carried on without them") {
  ego_estimator me{straight_street(), 100};
  me.on_report(told_east(departure, 100, 10));
  me.follow(plan_east(departure + 500ms, 104, 9, -5));
  CHECK(me.at(departure + 1s)->s_m == Approx(110));
}

TEST_CASE("a plan that has ended, or has not begun, says nothing") {
  ego_estimator me{straight_street(), 130};
  me.follow(plan_east(departure, 100, 10, -1));
  me.on_report(told_east(departure + 5900ms, 140, 4));
  CHECK(me.at(departure + 6900ms)->speed_mps == Approx(4));
  CHECK(me.at(departure - 100ms)->speed_mps == Approx(4));
}

TEST_CASE("after a gap without plans the earlier ones are forgotten") {
  ego_estimator me{straight_street(), 140};
  me.follow(plan_east(departure, 100, 10));
  me.on_report(told_east(departure + 5s, 150, 10));
  me.follow(plan_east(departure + 6500ms, 165, 10, -5));
  CHECK(me.at(departure + 7s)->speed_mps == Approx(10));
}

TEST_CASE("old news and old plans change nothing") {
  ego_estimator me{straight_street(), 100};
  me.on_report(told_east(departure, 100, 10));
  me.on_report(told_east(departure - 100ms, 50, 3));
  CHECK(me.at(departure)->s_m == Approx(100));
  me.follow(plan_east(departure, 100, 10, 1));
  me.follow(plan_east(departure - 1s, 300, 3));
  me.follow(plan_east(departure, 300, 3));
  CHECK(me.at(departure + 1s)->s_m == Approx(110.5));
}

TEST_CASE("more plans than are remembered leave the newest ones known") {
  ego_estimator me{straight_street(), 130};
  for (auto i = 0; i < 100; ++i)
    me.follow(plan_east(departure + i * 50ms, 100 + 0.5 * i, 10));
  const auto now = departure + 99 * 50ms;
  me.on_report(told_east(now - 1500ms, 100 + 49.5 - 15 + 0.25, 10.1));
  CHECK(me.at(now)->s_m == Approx(149.75));
  CHECK(me.at(now)->speed_mps == Approx(10.1));
}

TEST_CASE("who is not on its route is nowhere until it is back") {
  ego_estimator me{straight_street(), 100};
  me.on_report(told_east(departure, 100, 10));
  me.on_report(told_east(departure + 500ms, 105, 10, 5.1));
  CHECK_FALSE(me.at(departure + 1s));
  me.on_report(told_east(departure + 1s, 110, 10, 4.9));
  REQUIRE(me.at(departure + 1s));
  CHECK(me.at(departure + 1s)->d_m == Approx(4.9));
  me.on_report(told_east(departure + 2s, 300, 10)); // it cannot have got there
  CHECK_FALSE(me.at(departure + 2s));
}

TEST_CASE("what is not a number is not heard") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  constexpr auto inf = std::numeric_limits<double>::infinity();
  for (const auto wrong : {nan, inf, -inf}) {
    ego_estimator me{straight_street(), 100};
    for (auto i = 0; i < 6; ++i) {
      auto told = told_east(departure, 100, 10);
      double* fields[]{&told.position.x_m, &told.position.y_m,
                       &told.heading_rad,  &told.speed_mps,
                       &told.accel_mps2,   &told.curvature_1pm};
      *fields[i] = wrong;
      me.on_report(told);
      CHECK_FALSE(me.at(departure));
    }
  }
}

TEST_CASE("nonsense in numbers makes an input that a car can have") {
  ego_estimator me{straight_street(), 100};
  me.on_report({departure, {100, -4}, 1e300, 1e300, -1e300, 1e300});
  const auto x = *me.at(departure + 1s);
  CHECK(std::isfinite(x.s_m));
  CHECK(std::abs(x.d_m) <= 5);
  CHECK(std::abs(x.heading_error_rad) <= 1);
  CHECK(x.speed_mps <= 100);
  CHECK(std::abs(x.curvature_1pm) <= 1);
}

TEST_CASE("a car that is planned for from afar drives as well as at home") {
  // Told once a second at most, 40 ms late; plans arrive 20 ms late.
  const auto way = test::oval({{0, 12}});
  lane_follow planner{way, {}};
  const vehicle_params ability;
  const auto p = way->path().at(100);
  vehicle_state car{p.at, p.heading_rad, 8, 0, 0};
  ego_estimator me{way, 100};
  trajectory used, sent, before;
  auto worst_s = 0.0, worst_d = 0.0, worst_mps = 0.0;
  auto s_m = 100.0;
  std::optional<reported_state> told;
  for (auto i = 0; i < 6000; ++i) {
    const auto now = departure + i * 10ms;
    if (i % 100 == 0)
      told = {now,
              car.at,
              car.heading_rad,
              car.speed_mps,
              car.accel_mps2,
              std::tan(car.steer_rad) / ability.wheelbase_m};
    if (told && (i == 0 || i % 100 == 4))
      me.on_report(*told);
    if (i % 5 == 0) {
      const auto x = *me.at(now);
      const auto here = way->path().project(car.at, s_m, 5);
      s_m = here.s_m;
      worst_s = std::max(worst_s, std::abs(x.s_m - s_m));
      worst_d = std::max(worst_d, std::abs(x.d_m - here.d_m));
      worst_mps = std::max(worst_mps, std::abs(x.speed_mps - car.speed_mps));
      before = sent;
      planner.plan(now, x, before.empty() ? nullptr : &before, sent);
      me.follow(sent);
    }
    if (i % 5 == 2 || i == 0)
      used = sent;
    car = step(car, follow(car, used, now, ability), ability, 0.01);
  }
  CHECK(s_m > 400); // with both kinds of corners
  CHECK(worst_s < 0.3);
  CHECK(worst_d < 0.2);
  CHECK(worst_mps < 0.5);
}
