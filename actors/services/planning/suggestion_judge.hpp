// Judges what a provider suggests, by what the vehicle itself sees.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// Makes a `trajectory` along the vehicle's way of an MCM that suggests one. It
/// is refused as planners/judges/plan_judge says; where that wants a plan of
/// the vehicle's own to compare with, one is made from the latest input.
std::unique_ptr<offloading::result_judge>
make_suggestion_judge(planning_world_ptr world,
                      offloading::vehicle_context vehicle);

} // namespace sofof::actors
