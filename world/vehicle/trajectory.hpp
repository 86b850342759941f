// What a vehicle follows: where to be when, for the next seconds.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <vector>

namespace sofof::world {

/// One moment of a plan; the reference point is the rear axle's centre.
struct trajectory_point {
  double t_s = 0;         ///< Since the trajectory's start.
  double s_m = 0;         ///< Arc length on the route, laps included.
  point at;               ///< m, east-north.
  double heading_rad = 0; ///< Unwrapped along the trajectory.
  double curvature_1pm = 0;
  double speed_mps = 0;
  double accel_mps2 = 0;
};

void visit_fields(auto& v, trajectory_point& x) {
  v("t_s", x.t_s);
  v("s_m", x.s_m);
  v("at", x.at);
  v("heading_rad", x.heading_rad);
  v("curvature_1pm", x.curvature_1pm);
  v("speed_mps", x.speed_mps);
  v("accel_mps2", x.accel_mps2);
}

/// A plan in time; points in rising, equal steps of t, the first at 0.
struct trajectory {
  time_point start; ///< Start of the planning cycle (t_creation).
  std::vector<trajectory_point> points;

  bool empty() const { return points.empty(); }

  /// @returns whether it can be followed: at least two points, times
  /// rising in equal steps from 0, all numbers within what a road vehicle can
  /// do, speeds not negative. Ask before believing a stranger.
  bool is_sound() const;

  /// @returns the last moment that the plan covers; `start` when empty.
  time_point end() const;

  /// Between points the car moves at constant jerk on an arc, so that a plan
  /// read between its points is as true as at them: acceleration is linear in
  /// time; speed and arc length are its integrals; curvature and heading are
  /// linear in arc length. Clamped at both ends.
  /// Precondition: not empty.
  trajectory_point at(time_point t) const { return at(to_seconds(t - start)); }

  /// The same.
  /// @param t_s  Since the start.
  trajectory_point at(double t_s) const;
};

void visit_fields(auto& v, trajectory& x) {
  v("start", x.start);
  v("points", x.points);
}

/// @returns what a plan still holds from a time on, in the same steps; a plan
/// that begins later as it is, and nothing of one that is over.
trajectory rest_of(const trajectory& plan, time_point from);

} // namespace sofof::world
