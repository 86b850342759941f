// Braking to rest along the route.
#include "planners/trajectory/safe_stop.hpp"

#include "planners/scene/lane_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double step_s = 0.1;
constexpr double min_horizon_s = 6.0;
constexpr double standing_s = 2.0; // at the end of the plan, at least
constexpr double jerk_mps3 = 10.0;
constexpr double centring_length_m = 15.0;

/// Braking builds up, holds, and fades out as the car comes to rest.
double next_accel(const lane_motion& x, double decel_mps2) {
  assert(decel_mps2 > 0 && x.speed_mps >= 0);
  const auto soon = advance(x, x.accel_mps2, step_s);
  const auto fading = std::sqrt(2 * jerk_mps3 * soon.speed_mps);
  const auto wanted = -std::min(decel_mps2, fading);
  const auto change = jerk_mps3 * step_s;
  return std::clamp(wanted, x.accel_mps2 - change, x.accel_mps2 + change);
}

} // namespace

world::trajectory safe_stop(const world::route& way, time_point now,
                            const planning_input& state, double decel_mps2) {
  assert(decel_mps2 > 0);
  const centring line{way, moved_forward(state, now), centring_length_m};
  auto x = line.motion();
  const auto braking_s = x.speed_mps / decel_mps2
                         + (std::abs(x.accel_mps2) + decel_mps2) / jerk_mps3;
  const auto horizon_s = std::max(min_horizon_s, braking_s + standing_s);
  const auto steps = std::lround(std::ceil(horizon_s / step_s));

  world::trajectory plan;
  plan.start = now;
  plan.points.reserve(static_cast<std::size_t>(steps) + 1);
  for (long i = 0; i <= steps; ++i) {
    plan.points.push_back(line.place(x, static_cast<double>(i) * step_s));
    x = advance(x, next_accel(x, decel_mps2), step_s);
  }
  // Who speeds up harder at first comes to rest later.
  assert(x.speed_mps == 0 || state.accel_mps2 > decel_mps2);
  return plan;
}

} // namespace sofof::planners
