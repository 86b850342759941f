// How the car ahead is reckoned with.
#include "planners/speed/speed_constraints.hpp"

#include "planners/scene/lane_motion.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

TEST_CASE("a car ahead at constant speed never comes to rest") {
  const speed_constraints::follower ahead{20, {8, 0}};
  CHECK(ahead.way_left_m() == speed_constraints::never);
  CHECK(ahead.at(0) == 20);
  CHECK(ahead.at(5) == Approx(60));
  CHECK(ahead.when_s(60) == Approx(5));
}

TEST_CASE("a car ahead that brakes comes to rest and stays") {
  const speed_constraints::follower ahead{20, {8, -2}};
  CHECK(ahead.way_left_m() == Approx(16));
  CHECK(ahead.at(4) == Approx(36));
  CHECK(ahead.at(100) == Approx(36));
  CHECK(ahead.when_s(36 - 1e-9) == Approx(4).epsilon(1e-3));
  CHECK(ahead.when_s(36.01) == speed_constraints::never);
}

TEST_CASE("a car that stands stays where it is") {
  for (const auto accel : {0.0, -3.0}) {
    const speed_constraints::follower ahead{20, {0, accel}};
    CHECK(ahead.way_left_m() == 0);
    CHECK(ahead.at(10) == 20);
    CHECK(ahead.when_s(20.5) == speed_constraints::never);
  }
}

TEST_CASE("nobody reckons with a car ahead that speeds up") {
  const speed_constraints::follower ahead{20, {8, 1}};
  CHECK(ahead.at(5) == Approx(60));
  CHECK(ahead.when_s(60) == Approx(5));
  CHECK(ahead.way_left_m() == speed_constraints::never);
}

TEST_CASE("when a car ahead is where it is going to be") {
  test::dice dice{1};
  for (auto i = 0; i < 1000; ++i) {
    const leader lead{dice.between(0.1, 30),
                      std::min(0.0, dice.between(-6, 2))};
    const speed_constraints::follower ahead{dice.between(-5, 100), lead};
    const auto rest_s = lead.accel_mps2 < 0 ? -lead.speed_mps / lead.accel_mps2
                                            : speed_constraints::never;
    const auto t = dice.between(0, std::min(0.99 * rest_s, 20.0));
    CAPTURE(lead.speed_mps);
    CAPTURE(lead.accel_mps2);
    CAPTURE(t);
    CHECK(ahead.when_s(ahead.at(t)) == Approx(t));
    const auto moved = advance({ahead.touch_m, lead.speed_mps, lead.accel_mps2},
                               lead.accel_mps2, t);
    CHECK(ahead.at(t) == Approx(moved.s_m));
    CHECK(ahead.at(t) <= ahead.touch_m + ahead.way_left_m() + 1e-9);
  }
}
