// How long one car has to stay behind another at a crossing.
#pragma once

#include "planners/crossing/free_drive.hpp"
#include "world/roads/meeting_curve.hpp"

namespace sofof::planners {

/// What lies between two cars at a place that both use, s.
struct lag_margins {
  double crossing_s = 0.5;
  double following_s = 1.5; ///< On one lane, before or behind the crossing.
};

/// A car on its way to the crossing.
struct crossing_approach {
  const free_drive* drive = nullptr;
  double line_m = 0; ///< Of its middle, where the crossing begins for it.

  /// @returns when its middle is at its line; 0 if it has passed it.
  double line_s() const {
    return drive->time_s(std::max(line_m, drive->begins_m()));
  }
};

/// The time from the first car at its line to the second at its own one, if
/// both drive as soon as they can: the largest over all places of the second of
/// when the first has cleared it, later by the margin, less when the second
/// comes there.
/// @param meet     Of their two ways: the first car's, then the second's.
/// @param margin_s Between them.
/// @returns `order_problem::never_meet` where they do not.
double lag_s(const world::meeting_curve& meet, const crossing_approach& first,
             const crossing_approach& second, double margin_s);

} // namespace sofof::planners
