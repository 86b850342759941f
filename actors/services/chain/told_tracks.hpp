// The tracks that a provider tells, in the vehicle that uses them.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/result_judge.hpp"
#include "planners/scene/line_of_sight.hpp"

#include <memory>

namespace sofof::actors {

/// @param houses  Of the map, not null.
/// @returns a judge that makes tracks of CPMs, which are taken for the
/// sightings of a good sensor, and adds what the vehicle sees and they lack.
std::unique_ptr<offloading::result_judge>
make_track_reader(planning_world_ptr world,
                  std::shared_ptr<const planners::line_of_sight> houses);

} // namespace sofof::actors
