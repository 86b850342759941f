// The environment model in a vehicle and at a provider: what each has of it.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// From tracks, the map and what others tell of their drives: the scene on the
/// vehicle's own way.
std::shared_ptr<offloading::vehicle_service>
make_environment_in_vehicle(planning_world_ptr world,
                            offloading::vehicle_context vehicle);

/// The same from the tracks that the vehicle tells, or, if they were made at
/// this provider, from those.
std::shared_ptr<offloading::provider_service>
make_environment_at_provider(planning_world_ptr world,
                             offloading::provider_context provider);

} // namespace sofof::actors
