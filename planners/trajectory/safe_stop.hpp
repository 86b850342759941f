// The last resort: come to rest on the own lane, and stay there.
#pragma once

#include "planners/scene/planning_input.hpp"
#include "world/vehicle/trajectory.hpp"

namespace sofof::planners {

/// Brakes along the route to standstill, firmly but with limited jerk, and
/// stands for the rest of the horizon. Always succeeds.
/// @param way         The own route.
/// @param now         Start of the plan.
/// @param state       Own state; `others` is ignored.
/// @param decel_mps2  Braking, > 0.
world::trajectory safe_stop(const world::route& way, time_point now,
                            const planning_input& state,
                            double decel_mps2 = 4.0);

} // namespace sofof::planners
