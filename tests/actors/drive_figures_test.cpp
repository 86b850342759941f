// What counts as an emergency, and what as a change of source.
#include "actors/simulation/drive_figures.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

constexpr station_id station = 101;

/// Plans of a car at 10 m/s, and who made them.
struct driver {
  drive_figures figures{station, vehicle_params{}};
  session_id local{0, station, "trajectory_planning", 0};
  session_id remote{7, station, "trajectory_planning", 3};
  trajectory in_use = plan(0);

  static trajectory plan(double accel_mps2) {
    trajectory x;
    x.points.push_back({0, 0, {}, 0, 0.001, 10, 0});
    x.points.push_back({1, 10, {10, 0}, 0, 0.001, 10, accel_mps2});
    return x;
  }
  auto take(const session_id& from, double accel_mps2 = 0) {
    const auto next = plan(accel_mps2);
    plan_report report;
    report.emergency = accel_mps2 < -2.6;
    return figures.on_plan(in_use, next, report, from, next.start);
  }
  /// Drives on with jerks of 100 m/s³.
  void jolt(int steps) {
    for (auto i = 0; i < steps; ++i)
      figures.on_step(vehicle_state{{}, 0, 10, i % 10 < 5 ? 0. : 5., 0});
  }
};

} // namespace

TEST_CASE_FIXTURE(driver, "plans are counted until they are asked for") {
  take(local, 1);
  take(local, -2);
  auto x = figures.flush();
  CHECK(x.station == station);
  CHECK(x.plans.count == 2);
  CHECK(x.plans.emergency == 0);
  CHECK(x.plans.extremes.lateral_accel_mps2 == doctest::Approx(0.1));
  CHECK(x.plans.extremes.jerk_mps3 == doctest::Approx(2));
  CHECK(x.plans.extremes.min_accel_mps2 == -2);
  x = figures.flush();
  CHECK(x.station == station);
  CHECK(x.plans.count == 0);
  CHECK(x.plans.extremes.min_accel_mps2 == 0);
}

TEST_CASE_FIXTURE(driver, "a plan that brakes beyond comfort is an emergency "
                          "plan, and no measure of comfort") {
  take(local, -2.5);
  take(local, -2.7);
  const auto x = figures.flush().plans;
  CHECK(x.count == 2);
  CHECK(x.emergency == 1);
  CHECK(x.extremes.min_accel_mps2 == -2.5);
  CHECK(x.extremes.jerk_mps3 == 2.5);
}

TEST_CASE_FIXTURE(driver, "plans that are kept, stop, or were not solved are "
                          "counted as their reports say") {
  using enum ocp::solve_status;
  const auto take_one = [this](plan_origin origin, ocp::solve_status path,
                               ocp::solve_status velocity) {
    plan_report report;
    report.origin = origin;
    report.path = path;
    report.velocity = velocity;
    figures.on_plan(in_use, in_use, report, local, in_use.start);
    return figures.flush().plans;
  };
  auto x = take_one(plan_origin::planned, converged, acceptable);
  CHECK(x.count == 1);
  CHECK(x.kept + x.stops + x.imperfect == 0);
  x = take_one(plan_origin::kept, converged, converged);
  CHECK(x.kept == 1);
  CHECK(x.stops + x.imperfect == 0);
  x = take_one(plan_origin::stop, acceptable, converged);
  CHECK(x.stops == 1);
  CHECK(x.kept + x.imperfect == 0);
  CHECK(take_one(plan_origin::planned, budget, converged).imperfect == 1);
  x = take_one(plan_origin::stop, soft_infeasible, numerical);
  CHECK(x.count == 1);
  CHECK(x.stops == 1);
  CHECK(x.imperfect == 1);
}

TEST_CASE_FIXTURE(driver, "jerk is not taken while an emergency plan or a safe "
                          "stop is in use, nor a second after") {
  take(local);
  jolt(20);
  CHECK(figures.flush().ride.extremes.jerk_mps3 == doctest::Approx(100));
  SUBCASE("emergency plan") {
    take(local, -5);
  }
  SUBCASE("safe stop") {
    figures.stop_safely();
  }
  jolt(200);
  CHECK(figures.flush().ride.extremes.jerk_mps3 == 0);
  take(local);
  jolt(100);
  CHECK(figures.flush().ride.extremes.jerk_mps3 == 0);
  jolt(1);
  CHECK(figures.flush().ride.extremes.jerk_mps3 == doctest::Approx(100));
}

TEST_CASE_FIXTURE(driver, "to stand in the beginning is no safe stop, and to "
                          "go on stopping no second one") {
  figures.stop_safely();
  CHECK(figures.flush().plans.safe_stops == 0);
  take(local);
  figures.stop_safely();
  figures.stop_safely();
  CHECK(figures.flush().plans.safe_stops == 1);
  take(local);
  figures.stop_safely();
  CHECK(figures.flush().plans.safe_stops == 1);
}

TEST_CASE("a car that starts driving and never gets a plan makes a safe stop") {
  drive_figures figures{station, vehicle_params{}, 10};
  figures.on_step(vehicle_state{{}, 0, 10, 0, 0});
  CHECK(figures.flush().ride.distance_m == doctest::Approx(0.1));
  figures.stop_safely();
  figures.stop_safely();
  figures.on_step(vehicle_state{{}, 0, 10, -5, 0});
  const auto x = figures.flush();
  CHECK(x.plans.safe_stops == 1);
  CHECK(x.ride.extremes.jerk_mps3 == 0); // it is an emergency
}

TEST_CASE_FIXTURE(driver, "only plans from another source are a switch") {
  CHECK_FALSE(take(local).has_value()); // the first one
  CHECK_FALSE(take(local).has_value());
  const auto there = take(remote);
  REQUIRE(there.has_value());
  CHECK(there->remote);
  CHECK(there->session == remote);
  CHECK_FALSE(take(remote).has_value());
  auto next = remote;
  next.provider = 8;
  const auto onward = take(next);
  REQUIRE(onward.has_value());
  CHECK(onward->remote);
  CHECK(onward->session == next);
  const auto back = take(local);
  REQUIRE(back.has_value());
  CHECK_FALSE(back->remote);
  CHECK(back->session == next);
}

TEST_CASE_FIXTURE(driver, "after a safe stop there is nothing to switch from") {
  take(remote);
  figures.stop_safely();
  CHECK_FALSE(take(local).has_value());
}
