// Motion along a way, moment by moment: where speed plans end up.
#pragma once

#include "planners/problems/velocity_ocp.hpp"
#include "planners/scene/lane_motion.hpp"

#include <vector>

namespace sofof::planners {

/// `s_m` is the way from the car on; one entry every `step_s`, the first is
/// the car now.
using speed_profile = std::vector<lane_motion>;

/// Drives after a plan of the velocity problem. Between knots, where u is
/// constant, the way obeys x'' = a + u x in time, which is solved exactly: so
/// unlike the problem's own times, these hold down to standstill.
/// @param plan     Solved.
/// @param ds_m     Between its knots.
/// @param start_m  Way of its first knot.
/// @param start_s  When the car is there, seconds from now on, >= 0.
/// @param steps    How many entries `out` shall have besides the first.
/// @param out      Has the entries before `start_s` already; ends earlier
///                 than wanted where the plan does, unless that rests.
void drive_along(const velocity_ocp& plan, double ds_m, double start_m,
                 double start_s, double step_s, int steps, speed_profile& out);

} // namespace sofof::planners
