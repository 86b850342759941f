// Crossing management in a vehicle and at a provider.
#pragma once

#include "actors/services/crossing/crossing_options.hpp"
#include "offloading/service.hpp"

namespace sofof::actors {

/// In the vehicle there is no advice; it drives by its own rules.
std::shared_ptr<offloading::vehicle_service>
make_crossing_in_vehicle(crossing_world_ptr world,
                         offloading::vehicle_context vehicle);

std::shared_ptr<offloading::provider_service>
make_crossing_at_provider(crossing_world_ptr world,
                          offloading::provider_context provider);

} // namespace sofof::actors
