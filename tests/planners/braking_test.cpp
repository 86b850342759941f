// The braking laws, each driven to its end.
#include "planners/speed/braking.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

const braking_style default_braking;
constexpr auto dt_s = 0.01;

} // namespace

TEST_CASE("a car stops exactly at the place, gently, in finite time") {
  for (const auto speed : {1.0, 5.0, 13.9, 27.8}) {
    CAPTURE(speed);
    auto v = speed, room_m = 3 + speed * speed / 2;
    auto a = std::min(0.0, stop_accel(v, room_m, default_braking));
    auto seconds = 0.0, jerk = 0.0, strongest = 0.0;
    while (v > 1e-3 && seconds < 60) {
      const auto next = std::min(0.0, stop_accel(v, room_m, default_braking));
      if (v > 0.2)
        jerk = std::max(jerk, std::abs(next - a) / dt_s);
      a = next;
      strongest = std::min(strongest, a);
      room_m -= dt_s * (v + dt_s * a / 2);
      v += dt_s * a;
      seconds += dt_s;
    }
    CHECK(std::abs(room_m) < 0.01);
    CHECK(seconds < 6 + 0.6 * speed);
    CHECK(strongest > -1.01 * default_braking.decel_mps2);
    CHECK(jerk < 1.3 * default_braking.jerk_mps3);
  }
}

TEST_CASE("a place far away does not matter") {
  CHECK(stop_accel(13.9, 500, default_braking) > 1.5);
}

TEST_CASE("at its place, or beyond, a car brakes") {
  CHECK(stop_accel(1, 0, default_braking) == -default_braking.decel_mps2);
  CHECK(stop_accel(1, -2, default_braking) == -default_braking.decel_mps2);
}

TEST_CASE("at the desired gap and equal speed nothing is to be done") {
  CHECK(follow_accel(10, 10 * default_braking.time_gap_s, {10, 0},
                     default_braking)
        == Approx(0));
}

TEST_CASE("closing in from afar ends at the desired gap, without a swing") {
  auto v = 20.0, room_m = 200.0, least_m = 1e9;
  for (auto t = 0.0; t < 60; t += dt_s) {
    const auto a =
        std::min(1.5, follow_accel(v, room_m, {8, 0}, default_braking));
    CHECK(a > -1.01 * default_braking.decel_mps2);
    room_m += dt_s * (8 - v);
    v += dt_s * a;
    least_m = std::min(least_m, room_m);
  }
  CHECK(v == Approx(8).epsilon(1e-3));
  CHECK(room_m == Approx(8 * default_braking.time_gap_s).epsilon(1e-3));
  CHECK(least_m > 8 * default_braking.time_gap_s - 0.3);
}

TEST_CASE("a ripple of the car ahead fades from car to car") {
  for (const auto radps : {0.1, 0.3, 1.0, 3.0}) {
    CAPTURE(radps);
    auto v = 10.0, room_m = 10 * default_braking.time_gap_s, swing = 0.0;
    for (auto t = 0.0; t < 200; t += dt_s) {
      const auto ahead = 10 + 0.5 * std::sin(radps * t);
      const auto a = follow_accel(v, room_m, {ahead, 0}, default_braking);
      room_m += dt_s * (ahead - v);
      v += dt_s * a;
      if (t > 100)
        swing = std::max(swing, std::abs(v - 10));
    }
    CHECK(swing < 0.5);
  }
}

TEST_CASE("the needed braking is enough, and no less is") {
  struct situation {
    double speed, room_m;
    leader ahead;
  };
  for (const auto& [speed, room, lead] : {situation{14, 20, {14, -6}},
                                          {14, 30, {5, 0}},
                                          {14, 40, {0, 0}},
                                          {20, 10, {18, -1}},
                                          {5, 4, {6, -6}}}) {
    const auto needed = needed_decel(speed, room, lead);
    const auto least_room_m = [&](double decel) {
      auto v = speed, gap = room, ahead = lead.speed_mps, least = room;
      for (auto t = 0.0; t < 30; t += 1e-3) {
        gap += 1e-3 * (ahead - v);
        v = std::max(0.0, v - 1e-3 * decel);
        ahead = std::max(0.0, ahead + 1e-3 * lead.accel_mps2);
        least = std::min(least, gap);
      }
      return least;
    };
    CAPTURE(speed);
    CHECK(least_room_m(needed) > -0.05);
    CHECK(least_room_m(needed) < 0.05);
    CHECK(least_room_m(0.95 * needed) < -0.05);
  }
}

TEST_CASE("a car ahead that drives away needs no braking") {
  CHECK(needed_decel(10, 5, {12, 0}) == 0);
  CHECK(needed_decel(0, 5, {0, 0}) == 0);
}
