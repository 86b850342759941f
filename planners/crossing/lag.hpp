// How long one car has to stay behind another at a crossing.
#pragma once

#include "planners/crossing/way_motion.hpp"
#include "world/roads/meeting_curve.hpp"

namespace sofof::planners {

/// What lies between two cars at a place that both use.
struct lag_margins {
  double crossing_s = 0.5;
  double following_s = 1.5; ///< On one lane, before or behind the crossing,
  double following_m = 3;   ///< and so much more between their bumpers.
};

/// What two cars keep between them.
struct kept_apart {
  double by_s = 0, by_m = 0;
};

/// @returns how much later than it is going to the second car has to be at all
/// of its places, so that the first has cleared them by then, s; negative if it
/// might come sooner; `order_problem::never_meet` where they do not.
double delay_s(const world::meeting_curve& meet, const way_motion& first,
               const way_motion& second, kept_apart gap);

} // namespace sofof::planners
