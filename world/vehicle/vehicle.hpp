// A car: kinematic bicycle with slow actuators, and the controller that makes
// it follow a plan.
#pragma once

#include "base/geometry.hpp"
#include "world/vehicle/trajectory.hpp"

namespace sofof::world {

/// Size and ability of a car; the defaults are the test vehicle's
/// (5.10 m × 1.89 m, wheelbase 3.165 m).
struct vehicle_params {
  double wheelbase_m = 3.165;
  double front_m = 4.0175; ///< Rear axle to front bumper.
  double rear_m = 1.0825;  ///< Rear axle to rear bumper.
  double width_m = 1.89;
  double steer_lag_s = 0.15; ///< First-order lag of the steering.
  double drive_lag_s = 0.25; ///< First-order lag of drive and brake.
  double max_steer_rad = 0.6;
  double max_accel_mps2 = 3.0;
  double max_decel_mps2 = 8.0;
};

/// Motion of a car; the reference point is the rear axle's centre.
struct vehicle_state {
  point at;               ///< m, east-north.
  double heading_rad = 0; ///< Counter-clockwise from east.
  double speed_mps = 0;   ///< Never negative.
  double accel_mps2 = 0;
  double steer_rad = 0; ///< Front wheel angle, left positive.
};

void visit_fields(auto& v, vehicle_state& x) {
  v("at", x.at);
  v("heading_rad", x.heading_rad);
  v("speed_mps", x.speed_mps);
  v("accel_mps2", x.accel_mps2);
  v("steer_rad", x.steer_rad);
}

/// What the controller asks of the actuators.
struct vehicle_command {
  double accel_mps2 = 0;
  double steer_rad = 0;
};

/// One step of the kinematic bicycle with first-order actuator lag
/// (exact for the lags, midpoint rule for the pose). Commands beyond the
/// car's ability are cut; a car that has stopped stands, whatever the brake.
/// @param dt_s  > 0, at most 0.05.
vehicle_state step(const vehicle_state& x, const vehicle_command& u,
                   const vehicle_params& car, double dt_s);

/// Trajectory tracking: feed-forward of curvature and acceleration, both
/// advanced by the actuators' lag, and feedback of the lateral, heading,
/// along-track and speed errors. Where the plan stands, the brake is held.
/// @param plan  Not empty.
/// @param now   Where on the plan the car should be.
vehicle_command follow(const vehicle_state& x, const trajectory& plan,
                       time_point now, const vehicle_params& car);

/// @returns the footprint of the car.
oriented_box body(const vehicle_state& x, const vehicle_params& car);

} // namespace sofof::world
