// The braking laws.
#include "planners/speed/braking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double no_room_m = 1e-3;

} // namespace

double stop_accel(double speed_mps, double room_m, const braking_style& style) {
  assert(style.decel_mps2 > 0 && style.jerk_mps3 > 0);
  assert(!(speed_mps < 0));
  const auto b = style.decel_mps2, j = style.jerk_mps3;
  if (room_m <= 0)
    return -b;
  // The fastest profile: backwards from rest at constant jerk, v ~ D^(2/3),
  // until the braking is b; before that, v² ~ 2 b D.
  const auto fading_m = b * b * b / (6 * j * j);
  const auto fades = room_m <= fading_m;
  const auto profile_mps = fades ? std::cbrt(4.5 * j * room_m * room_m)
                                 : std::sqrt(2 * b * (room_m - fading_m / 4));
  assert(!(profile_mps <= 0)); // there is room
  const auto slope_1ps = fades ? profile_mps / (1.5 * room_m) : b / profile_mps;
  const auto accel =
      style.rate_1ps() * (profile_mps - speed_mps) - slope_1ps * speed_mps;
  if (speed_mps > profile_mps)
    return accel;
  // Below the profile its last part, scaled, also ends at the place.
  return std::max(accel, -speed_mps * speed_mps / (1.5 * room_m));
}

double follow_accel(double speed_mps, double room_m, const leader& ahead,
                    const braking_style& style) {
  assert(style.decel_mps2 > 0 && style.jerk_mps3 > 0);
  assert(style.time_gap_s > 0 && !(speed_mps < 0));
  const auto b = style.decel_mps2, gap_s = style.time_gap_s;
  const auto excess_m = room_m - gap_s * speed_mps;
  // Closing speed over the excess of the gap: linear when near, at constant
  // braking b from further away.
  const auto near_m = b * gap_s * gap_s;
  const auto near = excess_m <= near_m;
  const auto closing_mps =
      near ? excess_m / gap_s : std::sqrt(2 * b * (excess_m - near_m / 2));
  const auto slope_1ps = near ? 1 / gap_s : b / closing_mps;
  assert(!(slope_1ps <= 0));
  const auto slower_mps = ahead.speed_mps - speed_mps;
  return (ahead.accel_mps2 + slope_1ps * slower_mps
          + style.rate_1ps() * (slower_mps + closing_mps))
         / (1 + gap_s * slope_1ps);
}

double needed_decel(double speed_mps, double room_m, const leader& ahead) {
  assert(!(speed_mps < 0));
  const auto room = std::max(room_m, no_room_m);
  const auto braking = std::max(0.0, -ahead.accel_mps2);
  const auto closing = speed_mps - ahead.speed_mps;
  if (ahead.speed_mps > 0) {
    // Equal speeds before the car ahead stands?
    const auto until_equal_s = 2 * room / std::max(closing, no_room_m);
    if (closing <= 0 && braking == 0)
      return 0;
    if (closing > 0 && braking * until_equal_s <= ahead.speed_mps)
      return braking + closing * closing / (2 * room);
  }
  const auto its_way =
      braking > 0 ? ahead.speed_mps * ahead.speed_mps / (2 * braking) : 0;
  return speed_mps * speed_mps / (2 * (room + its_way));
}

} // namespace sofof::planners
