// Motions that need no optimisation: standing, moving up, braking, setting
// off.
#pragma once

#include "planners/speed/comfort_limits.hpp"
#include "planners/speed/speed_profile.hpp"

namespace sofof::planners {

/// Braking at `decel_mps2`, which builds up and fades out at `jerk_mps3`, to
/// rest, and standing.
/// @param out  Filled up to `steps` entries after the first.
void brake(const lane_motion& from, double decel_mps2, double jerk_mps3,
           double step_s, int steps, speed_profile& out);

/// Rolls up to a place and comes to rest there; small ways are not worth
/// setting off.
/// @param room_m  Way to the place.
void move_up(const lane_motion& from, double room_m,
             const comfort_limits& style, int steps, speed_profile& out);

/// A car that sets off, or lets go of the brake at walking pace, at constant
/// jerk until it is fast enough for the velocity problem, whose dynamics over
/// way cannot leave standstill.
struct setting_off {
  static constexpr double until_mps = 0.9;

  /// @returns whether the velocity problem cannot begin like this: the car is
  /// slower than `until_mps`, or would be within `way_m` at this braking.
  static bool is_needed(const lane_motion& from, double way_m);

  setting_off(const lane_motion& from, double jerk_mps3);

  double takes_s = 0;
  lane_motion end; ///< At `until_mps` or faster, not braking.

  /// Fills the entries before its end.
  void drive(double step_s, int steps, speed_profile& out) const;

private:
  lane_motion at(double t_s) const;

  lane_motion from_;
  double jerk_mps3_;
};

} // namespace sofof::planners
