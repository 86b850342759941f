// How a driver brakes: for a place to stop at, for a car ahead, and at last
// for whatever must not be hit. Each law is a function of the situation alone,
// so a plan made on the way continues the plan made before.
#pragma once

namespace sofof::planners {

/// How a driver likes to brake.
struct braking_style {
  double decel_mps2 = 2.0;
  double jerk_mps3 = 1.5;
  double time_gap_s = 1.5;

  /// How fast a speed error decays, so that braking sets in with `jerk_mps3`.
  double rate_1ps() const { return jerk_mps3 / decel_mps2; }
};

/// Acceleration that brings the car to rest at a place: braking sets in
/// gently, then is constant, then fades out at constant jerk, so that the car
/// is at rest in finite time and exactly there.
/// @param room_m  Way to the place, m; from 0 down the car just brakes.
/// @returns m/s²; positive when the car may go faster.
double stop_accel(double speed_mps, double room_m, const braking_style& style);

/// The car ahead.
struct leader {
  double speed_mps = 0;
  double accel_mps2 = 0; ///< Negative when it brakes, else 0.
};

/// Acceleration that keeps a gap that grows with speed: string stable when
/// near, at most the style's deceleration when closing in from afar.
/// @param room_m  Gap beyond the one at standstill, m; any sign.
double follow_accel(double speed_mps, double room_m, const leader& ahead,
                    const braking_style& style);

/// The constant braking that just avoids touching a car ahead that goes on
/// braking as it does (until it stands), or never lets go.
/// @param room_m  Way to it, m.
/// @returns m/s², >= 0; very large when there is no room.
double needed_decel(double speed_mps, double room_m, const leader& ahead);

} // namespace sofof::planners
