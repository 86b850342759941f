// How fast a route may be driven by what is seen of it.
#pragma once

#include "planners/scene/lane_network.hpp"
#include "planners/scene/route_sight.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "world/roads/route.hpp"

#include <vector>

namespace sofof::planners {

/// A car can stop within the part of its way that it sees, before a body that
/// it does not see yet; before a corner from which it does not see who goes
/// first, it can stop at the line, until it sees them. Where it never does, it
/// feels its way.
/// @param lanes  Where crossings are judged, else null.
/// @returns the speed at 0, 1, 2 … m of the route, to its end.
std::vector<double> sight_limits_mps(const world::route& way,
                                     const comfort_limits& style,
                                     const route_sight& sight,
                                     const lane_network* lanes);

} // namespace sofof::planners
