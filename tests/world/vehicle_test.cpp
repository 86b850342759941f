// The car and its tracking controller.
#include "world/vehicle/vehicle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::world;
using doctest::Approx;

namespace {

constexpr auto dt_s = 0.01;
const vehicle_params car;

vehicle_state after(double seconds, vehicle_state x, vehicle_command u,
                    double step_s = dt_s) {
  for (auto t = 0.0; t < seconds - step_s / 2; t += step_s)
    x = step(x, u, car, step_s);
  return x;
}

/// A bend that tightens and opens again, at a speed that changes: heading and
/// place are the integrals of curvature and speed.
trajectory winding(double duration_s, double speed_mps, double tightest_1pm) {
  trajectory plan;
  trajectory_point p;
  p.speed_mps = speed_mps;
  p.accel_mps2 = 1;
  constexpr auto fine = 100;
  for (auto i = 0; p.t_s < duration_s; ++i) {
    if (i % fine == 0)
      plan.points.push_back(p);
    const auto h = 0.1 / fine;
    p.t_s = (i + 1) * h;
    p.accel_mps2 = std::cos(p.t_s);
    const auto v = speed_mps + std::sin(p.t_s);
    const auto way = h * (p.speed_mps + v) / 2;
    p.speed_mps = v;
    p.s_m += way;
    p.heading_rad += way * p.curvature_1pm;
    p.at = p.at + way * point{std::cos(p.heading_rad), std::sin(p.heading_rad)};
    p.curvature_1pm = tightest_1pm * std::sin(p.t_s);
  }
  return plan;
}

struct tracking {
  double lateral_m = 0, along_m = 0, speed_mps = 0;
};

/// Worst errors when `x` follows `plan`.
tracking follow_all(const trajectory& plan, vehicle_state x) {
  tracking worst;
  for (auto now = plan.start; now < plan.end(); now += from_seconds(dt_s)) {
    x = step(x, follow(x, plan, now, car), car, dt_s);
    const auto p = plan.at(now + from_seconds(dt_s));
    const point tangent{std::cos(p.heading_rad), std::sin(p.heading_rad)};
    const auto off = x.at - p.at;
    worst.lateral_m = std::max(worst.lateral_m, std::abs(cross(tangent, off)));
    worst.along_m = std::max(worst.along_m, std::abs(dot(tangent, off)));
    worst.speed_mps =
        std::max(worst.speed_mps, std::abs(x.speed_mps - p.speed_mps));
  }
  return worst;
}

} // namespace

TEST_CASE("speed follows the drive's lag exactly, whatever the step") {
  vehicle_state x;
  x.speed_mps = 10;
  const auto fine = after(1, x, {2, 0}, 0.001);
  const auto coarse = after(1, x, {2, 0}, 0.05);
  const auto lag = car.drive_lag_s;
  CHECK(coarse.accel_mps2 == Approx(2 * (1 - std::exp(-1 / lag))));
  CHECK(coarse.speed_mps
        == Approx(10 + 2 - 2 * lag * (1 - std::exp(-1 / lag))));
  CHECK(fine.speed_mps == Approx(coarse.speed_mps));
  CHECK(distance_m(fine.at, coarse.at) < 1e-3);
}

TEST_CASE("a car at full lock drives a circle of its geometry's radius") {
  vehicle_state x;
  x.speed_mps = 5;
  x.steer_rad = 0.4;
  const auto radius_m = car.wheelbase_m / std::tan(0.4);
  const point centre{0, radius_m};
  for (auto i = 0; i < 1000; ++i) {
    x = step(x, {0, 0.4}, car, dt_s);
    REQUIRE(distance_m(x.at, centre) == Approx(radius_m).epsilon(1e-4));
  }
  CHECK(x.heading_rad == Approx(50 / radius_m));
}

TEST_CASE("a braking car stops, stands, and never reverses") {
  vehicle_state x;
  x.speed_mps = 3;
  const auto stopped = after(2, x, {-5, 0});
  CHECK(stopped.speed_mps == 0);
  CHECK(stopped.accel_mps2 == 0);
  CHECK(stopped.at.x_m > 0);
  const auto later = after(5, stopped, {-5, 0.3});
  CHECK(later.at == stopped.at);
  CHECK(after(1, later, {1, 0}).speed_mps > 0.5);
}

TEST_CASE("a car cannot do more than it is able to") {
  const auto x = after(5, {}, {100, 3});
  CHECK(x.accel_mps2 <= car.max_accel_mps2);
  CHECK(x.steer_rad <= car.max_steer_rad);
  CHECK(after(2, x, {-100, 0}).accel_mps2 >= -car.max_decel_mps2);
}

TEST_CASE("the body spans from bumper to bumper") {
  vehicle_state x;
  x.at = {10, 20};
  x.heading_rad = std::acos(-1) / 2;
  const auto box = body(x, car);
  CHECK(box.centre.x_m == Approx(10));
  CHECK(box.centre.y_m + box.length_m / 2 == Approx(20 + car.front_m));
  CHECK(box.centre.y_m - box.length_m / 2 == Approx(20 - car.rear_m));
  CHECK(box.width_m == car.width_m);
}

TEST_CASE("a car follows a winding plan within centimetres") {
  // lateral acceleration at most 2.5 m/s² each
  for (const auto& [speed, tightest] :
       {std::pair{4.0, 0.12}, {8.0, 0.03}, {14.0, 0.01}, {25.0, 0.003}}) {
    CAPTURE(speed);
    const auto plan = winding(30, speed, tightest);
    vehicle_state x;
    x.speed_mps = speed;
    x.accel_mps2 = 1;
    const auto worst = follow_all(plan, x);
    CHECK(worst.lateral_m < 0.05);
    CHECK(worst.along_m < 0.1);
    CHECK(worst.speed_mps < 0.1);
  }
}

TEST_CASE("a car beside its plan returns to it and does not swing over") {
  for (const auto speed : {2.0, 8.0, 14.0, 27.8}) {
    CAPTURE(speed);
    trajectory plan;
    for (auto i = 0; i <= 200; ++i)
      plan.points.push_back(
          {0.1 * i, 0.1 * i * speed, {0.1 * i * speed, 0}, 0, 0, speed, 0});
    vehicle_state x;
    x.at = {-0.5, 0.5};
    x.speed_mps = speed;
    auto right_m = 0.0, ahead_m = 0.0;
    for (auto now = plan.start; now < plan.end(); now += from_seconds(dt_s)) {
      x = step(x, follow(x, plan, now, car), car, dt_s);
      right_m = std::max(right_m, -x.at.y_m);
      ahead_m = std::max(ahead_m,
                         x.at.x_m - plan.at(now + from_seconds(dt_s)).at.x_m);
    }
    CHECK(std::abs(x.at.y_m) < 0.01);
    CHECK(right_m < 0.05);
    CHECK(ahead_m < 0.1);
    CHECK(std::abs(x.at.x_m - plan.points.back().at.x_m) < 0.03);
  }
}

TEST_CASE("where the plan stands the car stands, and its wheel is still") {
  trajectory plan;
  for (auto i = 0; i <= 50; ++i)
    plan.points.push_back({0.1 * i, 4, {4, 0}, 0, 0.05, 0, 0});
  vehicle_state x;
  x.at = {3.9, 0.1};
  x.speed_mps = 0.5;
  for (auto now = plan.start; now < plan.start + from_seconds(1.15);
       now += from_seconds(dt_s))
    x = step(x, follow(x, plan, now, car), car, dt_s);
  CHECK(x.speed_mps == 0);
  const auto before = x;
  x = step(x, follow(x, plan, plan.end(), car), car, dt_s);
  CHECK(x.at == before.at);
  CHECK(x.steer_rad == Approx(before.steer_rad).epsilon(1e-4));
}
