// The environment model of one vehicle at a provider.
#pragma once

#include "actors/services/planning/edge_perception.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// @returns a function from words of the vehicle (an MCM, and a CPM of its
/// tracks unless these are made at this provider) to scenes, who is asked for
/// tracks and drives by a planner there.
/// @param perceived  All that the provider hears: CAMs, and drives.
std::shared_ptr<offloading::service_function>
make_edge_environment(planning_world_ptr world,
                      offloading::provider_context provider, station_id vehicle,
                      std::shared_ptr<edge_perception> perceived);

} // namespace sofof::actors
