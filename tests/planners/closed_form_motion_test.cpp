// Motions that need no optimisation: what they keep, where they end.
#include "planners/speed/closed_form_motion.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr auto step_s = 0.1;

/// Neighbours fit each other; jerk stays below, but for the step to rest.
void check_smooth(const speed_profile& out, double jerk_mps3) {
  for (std::size_t i = 1; i < out.size(); ++i) {
    const auto &a = out[i - 1], &b = out[i];
    CAPTURE(i);
    REQUIRE(b.s_m >= a.s_m - 1e-4);
    REQUIRE(b.speed_mps >= 0);
    if (b.speed_mps == 0)
      continue;
    REQUIRE(std::abs(b.accel_mps2 - a.accel_mps2) <= jerk_mps3 * step_s + 1e-9);
    REQUIRE(
        b.speed_mps - a.speed_mps
        == Approx(step_s * (a.accel_mps2 + b.accel_mps2) / 2).epsilon(1e-6));
  }
}

/// How much faster it gets while it lets go of the throttle.
double rise_mps(double accel_mps2, double jerk_mps3) {
  return std::max(0.0, accel_mps2) * accel_mps2 / (2 * jerk_mps3);
}

} // namespace

TEST_CASE("braking comes to rest and stands, never firmer than told") {
  test::dice dice{1};
  for (auto i = 0; i < 500; ++i) {
    const lane_motion car{0, dice.between(0, 25), dice.between(-2, 2)};
    const auto decel = dice.between(2, 8), jerk = dice.between(5, 15);
    CAPTURE(car.speed_mps);
    CAPTURE(car.accel_mps2);
    speed_profile out;
    brake(car, decel, jerk, step_s, 200, out);
    REQUIRE(out.size() == 201);
    CHECK(out[0].speed_mps == car.speed_mps);
    CHECK(out[0].accel_mps2 == car.accel_mps2);
    check_smooth(out, jerk);
    for (const auto& x : out)
      CHECK(x.accel_mps2 >= std::min(-decel, car.accel_mps2) - 1e-9);
    CHECK(out.back().speed_mps == 0);
    CHECK(out.back().accel_mps2 == 0);
    const auto v = car.speed_mps + rise_mps(car.accel_mps2, jerk);
    const auto builds_up_s = (decel + std::max(0.0, car.accel_mps2)) / jerk;
    CHECK(out.back().s_m
          <= v * v / (2 * decel) + v * (builds_up_s + 2 * step_s) + 0.5);
  }
}

TEST_CASE("a car that moves up comes to rest at the place, in comfort, and "
          "not beyond") {
  const comfort_limits style;
  test::dice dice{2};
  for (auto i = 0; i < 500; ++i) {
    const auto room = dice.between(0.6, 5);
    const lane_motion car{0, i % 2 == 0 ? 0.0 : dice.between(0, 0.5), 0};
    CAPTURE(room);
    CAPTURE(car.speed_mps);
    speed_profile out;
    move_up(car, room, style, 300, out);
    REQUIRE(out.size() == 301);
    check_smooth(out, style.max_jerk_mps3);
    CHECK(out.back().speed_mps == 0);
    CHECK(out.back().s_m <= room + 0.02);
    CHECK(out.back().s_m >= room - 0.1);
    for (const auto& x : out) {
      CHECK(x.accel_mps2 <= style.max_accel_mps2 + 1e-9);
      CHECK(x.accel_mps2 >= -style.firm_decel_mps2() - 1e-9);
    }
  }
}

TEST_CASE("small ways are not worth setting off") {
  speed_profile out;
  for (const auto room : {-3.0, 0.0, 0.2, 0.45}) {
    move_up({0, 0, 0}, room, {}, 60, out);
    REQUIRE(out.size() == 61);
    CHECK(out.back().s_m == 0);
    CHECK(out.back().speed_mps == 0);
  }
}

TEST_CASE("a car sets off at constant jerk and never rolls back") {
  test::dice dice{3};
  for (auto i = 0; i < 500; ++i) {
    const lane_motion car{0, dice.between(0, 0.499), dice.between(-1.5, 1)};
    const setting_off off{car, 1.2};
    CAPTURE(car.speed_mps);
    CAPTURE(car.accel_mps2);
    CHECK(off.takes_s >= 0);
    CHECK(off.takes_s < 5);
    CHECK(off.end.speed_mps == Approx(setting_off::until_mps));
    CHECK(off.end.s_m >= 0);
    speed_profile out;
    off.drive(step_s, 60, out);
    REQUIRE(!out.empty());
    CHECK(out.front().speed_mps == Approx(car.speed_mps));
    CHECK(static_cast<double>(out.size() - 1) * step_s <= off.takes_s);
    CHECK(static_cast<double>(out.size()) * step_s > off.takes_s);
    for (std::size_t k = 1; k < out.size(); ++k) {
      CHECK(out[k].s_m >= out[k - 1].s_m);
      CHECK(out[k].speed_mps >= 0);
      CHECK(out[k].accel_mps2 - out[k - 1].accel_mps2 == Approx(1.2 * step_s));
    }
  }
}
