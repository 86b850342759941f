// How fast a route may be driven where.
#pragma once

#include "planners/scene/reference_line.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "world/roads/route.hpp"

#include <span>
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

  /// @param way       Its limits must be positive.
  /// @param most_mps  As in `reference_line`.
  speed_envelope(const world::route& way, const comfort_limits& params,
                 std::span<const double> most_mps = {});

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
