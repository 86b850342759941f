// Who agrees with others, for its vehicle, how to go through a crossing.
#pragma once

#include "actors/services/crossing/crossing_options.hpp"
#include "actors/simulation/service_client.hpp"

namespace sofof::actors {

/// The client of `crossing_management` in a vehicle: asks for advice, claims
/// the drives that it is advised, tells everybody, hears what they tell, and
/// says to the vehicle what was agreed. How is in planners/crossing/
/// crossing_member.
messages::crossing_driver_actor spawn_crossing_driver(const client_place& where,
                                                      crossing_world_ptr world,
                                                      duration input_period);

} // namespace sofof::actors
