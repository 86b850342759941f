// When a car would be where, if it were alone.
#pragma once

#include "planners/speed/route_profile.hpp"

#include <vector>

namespace sofof::planners {

/// How briskly cars go to a crossing and over it.
struct free_drive_limits {
  double accel_mps2 = 1.5;
  double decel_mps2 = 2.0; ///< Only where a car is faster than its way allows.
};

/// The soonest drive along a route from where a car is: it accelerates up to
/// what the route allows. Without limits of jerk.
class free_drive {
public:
  /// @param s_m        Of its middle, arc length on the route.
  /// @param speed_mps  >= 0.
  /// @param to_m       As far as it is looked at, > s_m.
  free_drive(const route_profile& way, const free_drive_limits& limits,
             double s_m, double speed_mps, double to_m);

  /// @returns after how long its middle is at a place, s; beyond the end at the
  /// last speed, behind the begin as if it had come at its speed (or at
  /// walking pace).
  double time_s(double s_m) const;

  double begins_m() const { return s_m_; }
  double ends_m() const;

private:
  static constexpr double step_m = 1;

  double s_m_;
  double first_mps_;
  std::vector<double> times_s_; // every step from the begin on
  double last_mps_ = 0;
};

} // namespace sofof::planners
