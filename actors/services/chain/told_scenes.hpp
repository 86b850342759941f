// The scenes that a provider tells, in the vehicle that uses them.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/result_judge.hpp"

#include <memory>

namespace sofof::actors {

/// @returns a judge that reads scene messages, and holds what they tell to what
/// the vehicle would make of its own tracks and map.
std::unique_ptr<offloading::result_judge>
make_scene_reader(planning_world_ptr world, station_id vehicle);

} // namespace sofof::actors
