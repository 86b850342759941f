// Motions that need no optimisation.
#include "planners/speed/closed_form_motion.hpp"

#include "planners/speed/braking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double at_rest_mps = 0.05;
constexpr double worth_moving_up_m = 0.5;
[[maybe_unused]] constexpr double motion_rounding = 1e-9;

/// Towards a wish, as fast as jerk allows.
double towards(double wanted, double accel, double change) {
  return std::clamp(wanted, accel - change, accel + change);
}

} // namespace

void brake(const lane_motion& from, double decel_mps2, double jerk_mps3,
           double step_s, int steps, speed_profile& out) {
  assert(decel_mps2 > 0 && jerk_mps3 > 0);
  assert(from.speed_mps >= 0 && step_s > 0 && steps >= 0);
  auto x = from;
  for (out.assign(1, x); static_cast<int>(out.size()) <= steps;) {
    const auto soon = advance(x, x.accel_mps2, step_s);
    const auto fading = std::sqrt(2 * jerk_mps3 * soon.speed_mps);
    const auto wanted = -std::min(decel_mps2, fading);
    x = advance(x, towards(wanted, x.accel_mps2, jerk_mps3 * step_s), step_s);
    assert(x.speed_mps >= 0 && x.s_m >= out.back().s_m);
    out.push_back(x);
  }
  assert(static_cast<int>(out.size()) == steps + 1);
}

void move_up(const lane_motion& from, double room_m,
             const comfort_limits& style, int steps, speed_profile& out) {
  assert(style.step_s > 0 && style.max_jerk_mps3 > 0);
  assert(from.speed_mps >= 0 && steps >= 0);
  const auto jerk = style.max_jerk_mps3;
  const braking_style braking{style.comfort_decel_mps2, 0.8 * jerk,
                              style.time_gap_s};
  auto x = from;
  const auto stays = from.speed_mps < at_rest_mps && room_m < worth_moving_up_m;
  for (out.assign(1, x); static_cast<int>(out.size()) <= steps;) {
    const auto soon = advance(x, x.accel_mps2, style.step_s);
    auto wanted =
        std::clamp(stop_accel(soon.speed_mps, room_m - soon.s_m, braking),
                   -style.firm_decel_mps2(), style.max_accel_mps2);
    if (stays)
      wanted = std::min(wanted, -style.comfort_decel_mps2);
    assert(std::isfinite(wanted));
    x = advance(x, towards(wanted, x.accel_mps2, jerk * style.step_s),
                style.step_s);
    out.push_back(x);
  }
}

bool setting_off::is_needed(const lane_motion& from, double way_m) {
  const auto later = from.speed_mps * from.speed_mps / 2
                     + std::min(from.accel_mps2, 0.0) * way_m;
  return later < until_mps * until_mps / 2;
}

setting_off::setting_off(const lane_motion& from, double jerk_mps3)
    : from_{from}, jerk_mps3_{jerk_mps3} {
  assert(jerk_mps3 > 0 && from.speed_mps >= 0);
  // Never backwards: it lets go of the brake in time.
  from_.accel_mps2 =
      std::max(from.accel_mps2, -std::sqrt(1.9 * jerk_mps3 * from.speed_mps));
  const auto a = from_.accel_mps2;
  // Its lowest speed is at a = 0; if that is too low, on to `until_mps`.
  const auto left = a * a + 2 * jerk_mps3 * (until_mps - from.speed_mps);
  takes_s = (std::sqrt(std::max(left, 0.0)) - a) / jerk_mps3;
  end = at(takes_s);
  assert(takes_s >= 0);
  assert(end.speed_mps >= until_mps - motion_rounding
         && end.accel_mps2 >= -motion_rounding);
}

lane_motion setting_off::at(double t_s) const {
  const auto j = jerk_mps3_, a = from_.accel_mps2, v = from_.speed_mps;
  return {from_.s_m + t_s * (v + t_s * (a / 2 + t_s * j / 6)),
          v + t_s * (a + t_s * j / 2), a + j * t_s};
}

void setting_off::drive(double step_s, int steps, speed_profile& out) const {
  assert(step_s > 0 && steps >= 0);
  for (out.clear(); static_cast<int>(out.size()) <= steps;) {
    const auto t = static_cast<double>(out.size()) * step_s;
    if (t > takes_s)
      return;
    out.push_back(at(t));
    assert(out.back().speed_mps >= -motion_rounding); // never backwards
  }
}

} // namespace sofof::planners
