// One vehicle's part of what a provider perceives.
#pragma once

#include "actors/services/planning/edge_perception.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// @returns a function from looks of the vehicle to tracks, who is asked for
/// them by an environment model there.
/// @param perceived  All that the provider hears; the looks are added to it.
std::shared_ptr<offloading::service_function>
make_edge_tracking(planning_world_ptr world,
                   offloading::provider_context provider, station_id vehicle,
                   std::shared_ptr<edge_perception> perceived);

} // namespace sofof::actors
