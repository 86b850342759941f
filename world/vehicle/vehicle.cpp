// The kinematic bicycle and its tracking controller.
#include "world/vehicle/vehicle.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {
namespace {

// Feedback of the tracking controller. Errors decay critically damped; the
// lateral ones in time when fast, in way when slow, or the wheel would saw at
// standstill.
constexpr double lateral_bandwidth_radps = 2.0;
constexpr double lateral_soft_speed_mps = 4.0;
constexpr double speed_gain_1ps = 1.5;
constexpr double way_gain_1ps2 = 0.6;
constexpr double max_feedback_1pm = 0.1;

constexpr double stands_below_mps = 0.01;
constexpr double holding_brake_mps2 = 0.5;

} // namespace

vehicle_state step(const vehicle_state& x, const vehicle_command& u,
                   const vehicle_params& car, double dt_s) {
  assert(dt_s > 0 && dt_s <= 0.05);
  const auto wheel =
      std::clamp(u.steer_rad, -car.max_steer_rad, car.max_steer_rad);
  const auto drive =
      std::clamp(u.accel_mps2, -car.max_decel_mps2, car.max_accel_mps2);
  const auto steer_after = [&](double t) {
    return wheel + (x.steer_rad - wheel) * std::exp(-t / car.steer_lag_s);
  };
  const auto fade = std::exp(-dt_s / car.drive_lag_s);
  const auto excess = x.accel_mps2 - drive;

  vehicle_state next;
  next.steer_rad = steer_after(dt_s);
  next.accel_mps2 = drive + excess * fade;
  next.speed_mps =
      x.speed_mps + drive * dt_s + excess * car.drive_lag_s * (1 - fade);
  if (next.speed_mps <= 0) {
    next.speed_mps = 0;
    next.accel_mps2 = std::max(next.accel_mps2, 0.0);
  }
  const auto way = 0.5 * (x.speed_mps + next.speed_mps) * dt_s;
  const auto turn = way * std::tan(steer_after(dt_s / 2)) / car.wheelbase_m;
  const auto course = x.heading_rad + turn / 2;
  next.at = x.at + way * point{std::cos(course), std::sin(course)};
  next.heading_rad = x.heading_rad + turn;
  return next;
}

vehicle_command follow(const vehicle_state& x, const trajectory& plan,
                       time_point now, const vehicle_params& car) {
  assert(!plan.empty());
  const auto here = plan.at(now);
  const auto wheel_then = plan.at(now + from_seconds(car.steer_lag_s));
  const auto drive_then = plan.at(now + from_seconds(car.drive_lag_s));

  const point tangent{std::cos(here.heading_rad), std::sin(here.heading_rad)};
  const auto ahead = dot(tangent, x.at - here.at);
  const auto left = cross(tangent, x.at - here.at);
  const auto turned =
      wrap_angle(x.heading_rad - here.heading_rad - here.curvature_1pm * ahead);

  const auto rate_1pm =
      lateral_bandwidth_radps / (x.speed_mps + lateral_soft_speed_mps);
  const auto feedback_1pm =
      std::clamp(-rate_1pm * (rate_1pm * left + 2 * std::sin(turned)),
                 -max_feedback_1pm, max_feedback_1pm);
  vehicle_command u;
  u.steer_rad =
      std::atan(car.wheelbase_m * (wheel_then.curvature_1pm + feedback_1pm));

  const auto will_stand = drive_then.speed_mps < stands_below_mps;
  if (will_stand && here.speed_mps < stands_below_mps) {
    u.accel_mps2 = -std::max(holding_brake_mps2, speed_gain_1ps * x.speed_mps);
  } else {
    // A car that comes to rest needs not let go of the brake before.
    const auto planned = will_stand
                             ? std::min(here.accel_mps2, drive_then.accel_mps2)
                             : drive_then.accel_mps2;
    u.accel_mps2 = planned + speed_gain_1ps * (here.speed_mps - x.speed_mps)
                   - way_gain_1ps2 * ahead;
  }
  return u;
}

oriented_box body(const vehicle_state& x, const vehicle_params& car) {
  const auto middle_m = 0.5 * (car.front_m - car.rear_m);
  const point forward{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  return {x.at + middle_m * forward, x.heading_rad, car.front_m + car.rear_m,
          car.width_m};
}

} // namespace sofof::world
