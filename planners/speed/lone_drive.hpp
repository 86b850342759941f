// How long a way takes a car that is alone on it.
#pragma once

#include "planners/speed/route_profile.hpp"

namespace sofof::planners {

/// The free flow that delays are reckoned from: as fast as the route's envelope
/// allows, speeding up and stopping as comfort does, with its front at rest at
/// the end of an open route. Jerk counts where the car sets off and comes to
/// rest by the time that it costs; what a planner spends on caution at
/// crossings or on other cars does not count.
/// @param road       Its envelope of the same style.
/// @param from_m     Rear axle on the route, where it begins.
/// @param speed_mps  >= 0, there.
/// @param to_m       >= from_m; on a closed route laps included.
/// @returns s.
double lone_drive_s(const route_profile& road, const comfort_limits& style,
                    double from_m, double speed_mps, double to_m);

} // namespace sofof::planners
