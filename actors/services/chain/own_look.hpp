// What a vehicle's own sensor looked at, as those who judge results need it.
#pragma once

#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "planners/plausibility/witness.hpp"

namespace sofof::actors {

/// @returns the look that came with a request. The bodies stay there.
planners::road_look own_look(const plan_request& request,
                             const planning_world& world);

} // namespace sofof::actors
