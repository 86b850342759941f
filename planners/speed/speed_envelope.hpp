// How fast a route may be driven where.
#pragma once

#include "planners/scene/route_sight.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "world/roads/route.hpp"

#include <vector>

namespace sofof::planners {

/// The speed that a route allows where, with bends and the braking before
/// them, already limited in jerk: computed once per route, then only looked
/// up.
class speed_envelope {
public:
  /// Speed at a place, and the acceleration of a car that drives it.
  struct sample {
    double speed_mps = 0;
    double accel_mps2 = 0;
  };

  /// @param way    Its limits must be positive.
  /// @param sight  What is seen from it; null: enough.
  /// @param lanes  Where crossings are judged, else null: at blind corners a
  ///               car can stop, and feels its way where it never sees.
  speed_envelope(const world::route& way, const comfort_limits& params,
                 const route_sight* sight = nullptr,
                 const lane_network* lanes = nullptr);

  /// @param s_m  Arc length on the route; closed routes wrap, open ones
  ///             clamp.
  sample at(double s_m) const;

  double limit_mps(double s_m) const { return at(s_m).speed_mps; }

private:
  std::vector<sample> table_; // equidistant, 1 m or less, both ends included
  double steps_per_m_ = 0;
  double laps_per_m_ = 0;
  double length_m_ = 0;
  bool closed_ = false;
};

} // namespace sofof::planners
