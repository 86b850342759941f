// A plan to begin with: straight on until a planner has made a better one.
#pragma once

#include "world/roads/route.hpp"
#include "world/vehicle/trajectory.hpp"

namespace sofof::planners {

/// Keeps to the middle of the lane at constant speed for 3 s, whatever the
/// limits, the bends and the others.
/// @param now        Start of the plan.
/// @param s_m        Rear axle on the route, then.
/// @param speed_mps  0 or more; 0 stands.
world::trajectory keep_speed(const world::route& way, time_point now,
                             double s_m, double speed_mps);

} // namespace sofof::planners
