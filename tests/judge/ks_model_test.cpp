// Drives as CommonRoad's kinematic single-track model has them.
#include "experiments/judge/ks_model.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace sofof::ks_model {

using namespace experiments::judge;

namespace {

/// A drive on a circle, or straight on.
std::vector<driven_moment> circle(double speed_mps, double bend_1pm) {
  const world::vehicle_params car;
  std::vector<driven_moment> all;
  for (auto k = 0; k <= 300; ++k) {
    const auto turned = speed_mps * 0.01 * k * bend_1pm;
    const point at =
        bend_1pm == 0
            ? point{speed_mps * 0.01 * k, 0}
            : 1 / bend_1pm * point{std::sin(turned), 1 - std::cos(turned)};
    all.push_back(
        {0.01 * k,
         {at, turned, speed_mps, 0, std::atan(car.wheelbase_m * bend_1pm)}});
  }
  return all;
}

} // namespace

TEST_CASE("the middle of a body drives a larger circle than its rear axle") {
  const auto states = ks_states(circle(5, 0.1), 0.1, 4);
  REQUIRE(states.size() == 31);
  CHECK(states.front().step == 4);
  CHECK(states.back().step == 34);
  const auto radius_m = std::hypot(10, axle_to_middle_m);
  for (const auto& x : states) {
    CHECK(distance_m(x.at, {0, 10}) == doctest::Approx(radius_m));
    CHECK(x.speed_mps == doctest::Approx(5 * radius_m / 10));
    CHECK(x.steer_rad
          == doctest::Approx(std::atan(2.5789 / radius_m)).epsilon(0.001));
  }
  CHECK_FALSE(broken_limit(states, 0.1));
}

TEST_CASE("who stands keeps its wheel, and turns it before it sets off") {
  auto drive = circle(0, 0);
  auto bend = circle(5, 0.1);
  for (auto& m : bend) {
    m.t_s += 3.01;
    drive.push_back(m);
  }
  const auto states = ks_states(drive, 0.1, 0);
  for (std::size_t i = 1; i < 29; ++i)
    CHECK(std::abs(states[i].steer_rad - states[i - 1].steer_rad) < 0.04);
}

TEST_CASE("limits of the vehicle are kept, or named") {
  const auto straight = [](double speed_mps, double accel_mps2,
                           double steer_rad) {
    const ks_state a{3, {0, 0}, steer_rad, speed_mps, 0};
    auto b = a;
    b.step = 4;
    b.speed_mps += 0.1 * accel_mps2;
    b.at.x_m = 0.1 * (a.speed_mps + b.speed_mps) / 2;
    return std::vector{a, b};
  };
  CHECK_FALSE(broken_limit(straight(10, 3, 0), 0.1));
  CHECK_FALSE(broken_limit(straight(5, 11, 0), 0.1));
  CHECK(broken_limit(straight(20, 5, 0), 0.1)
            ->starts_with("an acceleration of 5.00 m/s² at step 3"));
  CHECK(broken_limit(straight(5, -12, 0), 0.1)
            ->starts_with("an acceleration of 12.00"));
  CHECK(broken_limit(straight(51, 0, 0), 0.1)->starts_with("a speed of 51.00"));
  CHECK(broken_limit(straight(0, 0, 1.1), 0.1)
            ->starts_with("a steering angle of 1.10 rad"));
  auto turning = straight(0, 0, 0);
  turning[1].steer_rad = 0.05;
  CHECK(broken_limit(turning, 0.1)->starts_with("a steering rate of 0.50"));
  auto jumping = straight(10, 0, 0);
  jumping[1].at.y_m = 0.02;
  CHECK(broken_limit(jumping, 0.1)->starts_with("the model misses"));
}

} // namespace sofof::ks_model
