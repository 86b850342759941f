// What a ride feels like.
#include "world/vehicle/ride_comfort.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::world;
using sofof::test::near;

namespace {

constexpr double wheelbase_m = 3;
constexpr double step_s = 0.01;

/// A car whose acceleration is given, step by step.
struct ride {
  ride_comfort meter{wheelbase_m};
  vehicle_state car;
  bool emergency = false;

  /// At constant acceleration.
  void go(double accel_mps2, double t_s) {
    car.accel_mps2 = accel_mps2;
    for (auto left = std::lround(t_s / step_s); left > 0; --left) {
      car.speed_mps += accel_mps2 * step_s;
      meter.add(car, emergency);
    }
  }
  /// At constant jerk, to this acceleration.
  void change(double accel_mps2, double t_s) {
    const auto steps = std::lround(t_s / step_s);
    const auto from = car.accel_mps2;
    for (auto i = 1L; i <= steps; ++i)
      go(std::lerp(from, accel_mps2,
                   static_cast<double>(i) / static_cast<double>(steps)),
         step_s);
  }
  /// Speeds up from rest, as gently as that.
  void start(double speed_mps) {
    change(1, 1);
    go(1, speed_mps - 1);
    change(0, 1);
    go(0, 0.1);
    meter.flush();
  }
};

} // namespace

TEST_CASE("jerk is seen through a window of 50 ms") {
  ride r;
  r.start(10);
  r.change(-1, 0.5);
  CHECK(r.meter.flush().extremes.jerk_mps3 == near(2, 1e-9));
  r.go(-1, 0.5);
  r.meter.flush();
  r.go(-0.9, 0.01); // one step is no more than what it does in 50 ms
  CHECK(r.meter.flush().extremes.jerk_mps3 == near(2, 1e-9));
  r.go(-0.9, 0.05);
  r.meter.flush();
  r.go(-0.9, 1);
  CHECK(r.meter.flush().extremes.jerk_mps3 == 0);
}

TEST_CASE("a jerk that is seen in two reports is seen whole") {
  ride r;
  r.start(10);
  r.change(0.05, 0.03);
  r.meter.flush();
  r.change(0.1, 0.02);
  CHECK(r.meter.flush().extremes.jerk_mps3 == near(2, 1e-9));
}

TEST_CASE("lateral acceleration is v² tan(steer) / wheelbase") {
  ride r;
  r.start(10);
  const auto v2 = r.car.speed_mps * r.car.speed_mps;
  r.car.steer_rad = -std::atan(0.03);
  r.go(0, 0.1);
  r.car.steer_rad = std::atan(0.02);
  r.go(0, 0.1);
  CHECK(r.meter.flush().extremes.lateral_accel_mps2 == near(v2 * 0.01, 1e-9));
}

TEST_CASE("a hard brake is counted once, when it begins") {
  ride r;
  r.start(30);
  r.change(-4, 1);
  r.go(-4, 1);
  r.meter.flush();
  r.go(-4, 1); // still the same one
  r.change(-2.9, 1);
  CHECK(r.meter.flush().hard_brakes == 0);
  r.change(-3.1, 1);
  r.change(-2.9, 1);
  r.change(-3, 1);
  const auto x = r.meter.flush();
  CHECK(x.hard_brakes == 1);
  CHECK(x.extremes.min_accel_mps2 == near(-3.1, 1e-9));
}

TEST_CASE("the distance is that of the speed") {
  ride r;
  r.start(10);
  r.change(-1, 1);
  r.change(0, 1);
  const auto v_mps = r.car.speed_mps;
  r.meter.flush();
  r.go(0, 5);
  CHECK(r.meter.flush().distance_m == near(5 * v_mps, 1e-9));
  r.go(1, 2);
  CHECK(r.meter.flush().distance_m == near(2 * v_mps + 2, 1e-9));
}

TEST_CASE("comfort costs the squares of acceleration and jerk, over time") {
  ride r;
  r.start(10);
  r.go(0, 1);
  CHECK(r.meter.flush().comfort_cost_m2ps3 == 0);
  r.change(-2, 1); // ∫ a² = 4/3, ∫ j² = 4 but for the window
  CHECK(r.meter.flush().comfort_cost_m2ps3 == near(4. / 3 + 4, 0.15));
  r.go(-2, 0.05);
  r.meter.flush();
  r.go(-2, 2);
  CHECK(r.meter.flush().comfort_cost_m2ps3 == near(8, 1e-9));
}

TEST_CASE("coming to rest is no jerk, driving off again is") {
  ride r;
  r.start(4);
  r.change(-0.5, 1);
  while (r.car.speed_mps > 0.01)
    r.go(-0.5, step_s);
  r.meter.flush();
  r.car.speed_mps = 0;
  r.go(0, 1);
  CHECK(r.meter.flush().extremes.jerk_mps3 == 0);
  r.go(0.5, 0.1);
  CHECK(r.meter.flush().extremes.jerk_mps3 == near(10, 1e-9));
}

TEST_CASE("an emergency and the second after it are no measure of comfort, "
          "but braking and cost still count") {
  ride r;
  r.start(30);
  r.car.steer_rad = 0.01;
  r.emergency = true;
  r.change(-5, 0.5);
  r.emergency = false;
  r.change(0, 0.5);
  r.change(-1, 0.1);
  r.change(0, 0.1);
  r.car.steer_rad = 0;
  r.go(0, 0.35);
  auto x = r.meter.flush();
  CHECK(x.extremes.jerk_mps3 == 0);
  CHECK(x.extremes.lateral_accel_mps2 == 0);
  CHECK(x.extremes.min_accel_mps2 == near(-5, 1e-9));
  CHECK(x.hard_brakes == 1);
  CHECK(x.comfort_cost_m2ps3 > 20);
  r.change(1, 0.5);
  x = r.meter.flush();
  CHECK(x.extremes.jerk_mps3 == near(2, 1e-9));
}

TEST_CASE("rides add up to the sums and extremes of both") {
  ride_figures sum{100, {1, 2, -1}, 1, 5};
  sum.add({50, {0.5, 3, -2}, 2, 7});
  CHECK(sum.distance_m == 150);
  CHECK(sum.extremes.lateral_accel_mps2 == 1);
  CHECK(sum.extremes.jerk_mps3 == 3);
  CHECK(sum.extremes.min_accel_mps2 == -2);
  CHECK(sum.hard_brakes == 3);
  CHECK(sum.comfort_cost_m2ps3 == 12);
}
