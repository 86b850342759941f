// What a comfortable and safe drive is.
#pragma once

#include "base/options/option_visitor.hpp"
#include "world/vehicle/vehicle.hpp"

namespace sofof::planners {

/// What every planner keeps to.
struct comfort_limits {
  double horizon_s = 6.0;
  double step_s = 0.1;
  double max_accel_mps2 = 1.5;
  double comfort_decel_mps2 = 2.0;
  double max_decel_mps2 = 6.0; ///< Emergency.
  double max_jerk_mps3 = 1.5;
  double emergency_jerk_mps3 = 15.0;
  double max_lateral_accel_mps2 = 2.2;
  double time_gap_s = 1.5;
  double standstill_gap_m = 3.0;
  double centring_length_m = 15.0; ///< Offsets decay over this length; of
                                   ///< lane_follow alone.
  double front_m = world::vehicle_params{}.front_m; ///< Of the car; no option.

  /// No emergency brakes softer than this.
  static constexpr double least_emergency_mps2 = 2.5;

  /// Beyond comfort, before it is an emergency: corrections need a reserve.
  double firm_decel_mps2() const { return 1.25 * comfort_decel_mps2; }

  void visit_options(option_visitor& s);
};

} // namespace sofof::planners
