// A window of acceleration, and sums.
#include "world/vehicle/ride_comfort.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sofof::world {
namespace {

constexpr auto dt_s = to_seconds(protocol::control_period);
constexpr auto window_s = to_seconds(ride_comfort::jerk_window);

} // namespace

void ride_figures::add(const ride_figures& x) {
  distance_m += x.distance_m;
  extremes.add(x.extremes);
  hard_brakes += x.hard_brakes;
  comfort_cost_m2ps3 += x.comfort_cost_m2ps3;
}

void ride_comfort::add(const vehicle_state& x, bool emergency) {
  const auto before =
      std::exchange(window_[next_], {x.speed_mps, x.accel_mps2});
  next_ = (next_ + 1) % window_steps;
  const auto jerk = felt_jerk(before.speed_mps, x.speed_mps,
                              x.accel_mps2 - before.accel_mps2, window_s);
  const auto last_mps = std::exchange(speed_mps_, x.speed_mps);
  sum_.distance_m += 0.5 * (last_mps + x.speed_mps) * dt_s;
  sum_.comfort_cost_m2ps3 += (x.accel_mps2 * x.accel_mps2 + jerk * jerk) * dt_s;

  const auto hard = x.accel_mps2 < hard_mps2;
  sum_.hard_brakes += hard && !brakes_hard_;
  brakes_hard_ = hard;

  motion_extremes now{0, 0, x.accel_mps2};
  if (emergency) {
    unsettled_ = aftermath;
  } else if (unsettled_ > duration::zero()) {
    unsettled_ -= protocol::control_period;
  } else {
    const auto curvature_1pm = std::tan(x.steer_rad) / wheelbase_m_;
    now.lateral_accel_mps2 =
        x.speed_mps * x.speed_mps * std::abs(curvature_1pm);
    now.jerk_mps3 = jerk;
  }
  sum_.extremes.add(now);
}

ride_figures ride_comfort::flush() {
  return std::exchange(sum_, {});
}

} // namespace sofof::world
