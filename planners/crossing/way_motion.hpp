// When a vehicle is where on its way through a crossing.
#pragma once

#include "planners/speed/route_profile.hpp"

#include <cstddef>
#include <vector>

namespace sofof::planners {

/// Motion of a body along its way: when its middle is at a place, in seconds
/// from some moment on.
class way_motion {
public:
  static constexpr double step_m = 0.5;

  way_motion() = default;

  /// @param from_m   Where it begins, arc length on the route.
  /// @param times_s  There, and every `step_m` from there on; rising.
  way_motion(double from_m, std::vector<double> times_s);

  bool empty() const { return times_s_.empty(); }
  double begins_m() const { return from_m_; }
  double ends_m() const {
    return from_m_ + step_m * static_cast<double>(times_s_.size() - 1);
  }

  /// @returns when its middle is at a place, s; beyond the end as fast as
  /// there, before the begin as if it had come as fast as there, at 1 m/s at
  /// least. Not empty.
  double time_s(double at_m) const;

  /// @returns where its middle is at a time; before it begins and after it ends
  /// as there.
  double place_m(double at_s) const;

private:
  double from_m_ = 0;
  std::vector<double> times_s_;
};

/// How briskly cars go to a crossing and over it.
struct free_drive_limits {
  double accel_mps2 = 1.25;
  double decel_mps2 = 1.75; ///< Only where a car is faster than its way allows.
};

/// @returns the soonest drive along a route from where a car is, if it were
/// alone: it speeds up to what the route allows. Without limits of jerk.
/// @param s_m        Of its middle, arc length on the route.
/// @param speed_mps  >= 0.
/// @param to_m       As far as it is looked at, > s_m.
way_motion drive_freely(const route_profile& way,
                        const free_drive_limits& limits, double s_m,
                        double speed_mps, double to_m);

} // namespace sofof::planners
