// What every planner does: beginning where the plan in use is.
#include "planners/trajectory/trajectory_planner.hpp"

#include "planners/scene/lane_motion.hpp"
#include "tests/planners/test_drive.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;

namespace {

const time_point plan_time{from_seconds(50)};

/// Straight on along a straight road.
trajectory steady(time_point start, double s_m, double speed_mps) {
  trajectory t;
  t.start = start;
  for (auto i = 0; i <= 60; ++i) {
    const auto t_s = 0.1 * i;
    const auto s = s_m + speed_mps * t_s;
    t.points.push_back({t_s, s, {s, 0.1}, 0, 0, speed_mps, 0});
  }
  return t;
}

planning_input at(time_point when, double s_m, double speed_mps) {
  planning_input x;
  x.at = when;
  x.s_m = s_m;
  x.speed_mps = speed_mps;
  return x;
}

} // namespace

TEST_CASE("without a plan before, planning begins where the car will be") {
  const auto way = test::straight(500, {{0, 20}});
  auto x = at(plan_time - from_seconds(0.4), 100, 10);
  x.accel_mps2 = 1;
  x.d_m = 0.2;
  const auto start = joined(*way, plan_time, x, nullptr);
  CHECK(start.s_m == Approx(100 + 10 * 0.4 + 0.08));
  CHECK(start.speed_mps == Approx(10.4));
  CHECK(start.accel_mps2 == Approx(1));
  CHECK(start.d_m == Approx(0.2));
}

TEST_CASE("a plan that is followed well is gone on from") {
  const auto way = test::straight(500, {{0, 20}});
  const auto before = steady(plan_time - from_seconds(0.25), 100, 10);
  const auto start = joined(
      *way, plan_time, at(plan_time - from_seconds(0.1), 102, 10.4), &before);
  CHECK(start.s_m == Approx(102.5));
  CHECK(start.speed_mps == Approx(10));
  CHECK(start.d_m == Approx(0.1));
  CHECK(start.at == plan_time); // or who moves it forward goes too far
}

TEST_CASE("a plan that is not followed is not gone on from") {
  const auto way = test::straight(500, {{0, 20}});
  const auto before = steady(plan_time - from_seconds(0.25), 100, 10);
  const auto check_left = [&](const planning_input& x, const trajectory& t) {
    const auto start = joined(*way, plan_time, x, &t);
    const auto own = moved_forward(x, plan_time);
    CHECK(start.s_m == own.s_m);
    CHECK(start.speed_mps == own.speed_mps);
  };
  check_left(at(plan_time, 104, 10), before);     // too far on
  check_left(at(plan_time, 103.1, 10), before);   // likewise
  check_left(at(plan_time, 102.5, 11.5), before); // too fast
  check_left(at(plan_time, 102.5, 10), {});       // no plan
  check_left(at(plan_time, 102.5, 10),
             steady(plan_time - from_seconds(7), 40, 10)); // over
  check_left(at(plan_time, 102.5, 10),
             steady(plan_time + from_seconds(1), 40, 10));
}

TEST_CASE("an input older than the plan before still agrees with it") {
  const auto way = test::straight(500, {{0, 20}});
  const auto before = steady(plan_time - from_seconds(0.05), 100, 10);
  const auto start = joined(
      *way, plan_time, at(plan_time - from_seconds(0.4), 96.5, 10), &before);
  CHECK(start.s_m == Approx(100.5));
}

TEST_CASE("a car ahead goes on at its speed, or at its braking until it "
          "stands, but is never expected to speed up") {
  const auto later = [](lead_vehicle lead, double age_s) {
    return moved_forward(lead, plan_time - from_seconds(age_s), plan_time);
  };
  CHECK(later({1, 50, 10, 0}, 0.3).rear_s_m == Approx(53));
  CHECK(later({1, 50, 10, 2}, 0.3).rear_s_m == Approx(53));
  CHECK(later({1, 50, 10, 2}, 0.3).speed_mps == Approx(10));
  const auto brakes = later({1, 50, 10, -5}, 0.4);
  CHECK(brakes.rear_s_m == Approx(50 + 4 - 0.4));
  CHECK(brakes.speed_mps == Approx(8));
  CHECK(brakes.accel_mps2 == Approx(-5));
  const auto stands = later({1, 50, 1, -5}, 0.4);
  CHECK(stands.rear_s_m == Approx(50.1));
  CHECK(stands.speed_mps == 0);
}

TEST_CASE("a car ahead is taken on by half a second at most, and never back") {
  const lead_vehicle lead{1, 50, 10, 0};
  const auto old = moved_forward(lead, plan_time - from_seconds(9), plan_time);
  CHECK(old.rear_s_m == Approx(55));
  CHECK(moved_forward(lead, plan_time + from_seconds(1), plan_time).rear_s_m
        == 50);
}
