// How long a way takes a car that is alone on it.
#pragma once

#include "planners/speed/route_profile.hpp"

namespace sofof::planners {

/// The free flow that delays are reckoned from: the drive that the planner's
/// cost prefers where nobody else is (q_v (w − w_ref)²/(2 w_ref) + q_a a² along
/// the way, w = v²/2, no faster than the route's envelope), with its front at
/// rest at the end of an open route. Jerk counts by the time that it costs to
/// set off and to come to rest; caution at crossings does not count.
/// Source: the velocity problem of docs/planner.md, without its times.
/// @param road       Its envelope of the same style.
/// @param from_m     Rear axle on the route, where it begins.
/// @param speed_mps  >= 0, there.
/// @param to_m       >= from_m; on a closed route laps included.
/// @returns s.
double lone_drive_s(const route_profile& road, const comfort_limits& style,
                    double from_m, double speed_mps, double to_m);

} // namespace sofof::planners
