// Tracking in a vehicle and at a provider: what each has of it.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"
#include "planners/scene/line_of_sight.hpp"

#include <memory>

namespace sofof::actors {

/// From what the vehicle's own sensor sees, look by look.
/// @param houses  Of the map: what they hide is not missed. Not null.
std::shared_ptr<offloading::vehicle_service>
make_tracking_in_vehicle(planning_world_ptr world,
                         std::shared_ptr<const planners::line_of_sight> houses);

/// From what all that are heard tell, this vehicle's looks among it: one
/// tracker of the provider for all its clients.
std::shared_ptr<offloading::provider_service>
make_tracking_at_provider(planning_world_ptr world,
                          offloading::provider_context provider);

} // namespace sofof::actors
