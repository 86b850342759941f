// How smooth plans are: their extremes, and the jump from one to the next.
#pragma once

#include "base/time.hpp"
#include "world/vehicle/trajectory.hpp"

#include <cstdint>

namespace sofof::world {

/// Slower than this, m/s, a car that slows down comes to rest: what its
/// acceleration does in the last moment is no jerk of the ride.
inline constexpr double coming_to_rest_mps = 0.1;

/// The extremes of a motion; zero for a car that stands.
struct motion_extremes {
  double lateral_accel_mps2 = 0; ///< Largest |v² κ|.
  double jerk_mps3 = 0;          ///< Largest |jerk|.
  double min_accel_mps2 = 0;     ///< Lowest acceleration, at most 0.

  /// Becomes the extremes of both.
  void add(const motion_extremes& x);
};

void visit_fields(auto& v, motion_extremes& x) {
  v("lateral_accel_mps2", x.lateral_accel_mps2);
  v("jerk_mps3", x.jerk_mps3);
  v("min_accel_mps2", x.min_accel_mps2);
}

/// What a car that comes from `before` feels of jerk.
/// @param before_mps  Speed at the beginning.
/// @param change_mps2  Difference of acceleration over `dt_s`.
/// @returns its magnitude, m/s³; 0 while the car comes to rest.
double felt_jerk(double before_mps, double after_mps, double change_mps2,
                 double dt_s);

/// @param plan  Sound. Its jerk is that between neighbouring points.
motion_extremes extremes_of(const trajectory& plan);

/// The plans that a vehicle took into use.
struct plan_figures {
  std::uint64_t count = 0;      ///< All that a service made.
  std::uint64_t emergency = 0;  ///< Those of them that brake beyond comfort.
  std::uint64_t kept = 0;       ///< Those that are the one before, kept.
  std::uint64_t stops = 0;      ///< Those that brake, for want of better.
  std::uint64_t imperfect = 0;  ///< Path or speeds were not solved; kept ones
                                ///< and stops may be among them.
  std::uint64_t safe_stops = 0; ///< Made by the vehicle itself.
  motion_extremes extremes;     ///< Of all but emergency plans.

  void add(const plan_figures& x);
};

/// How far a plan is from the one that it replaces, all magnitudes.
struct plan_jump {
  double d_m = 0; ///< Along the normal of the old plan.
  double curvature_1pm = 0;
  double speed_mps = 0;
  double accel_mps2 = 0;
};

/// @param t  When `next` takes over from `old`; both are sound.
plan_jump jump_between(const trajectory& old, const trajectory& next,
                       time_point t);

} // namespace sofof::world
