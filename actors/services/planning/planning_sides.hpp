// Trajectory planning in a vehicle and at a provider: what each has of it.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "actors/simulation/plan_client.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// The vehicle says in MCMs where it may go, and which plan it follows to a
/// provider that takes over; it judges what is suggested to it.
std::shared_ptr<offloading::vehicle_service>
make_planning_in_vehicle(planning_world_ptr world,
                         offloading::vehicle_context vehicle);

/// How the vehicle asks its own function: by `plan_request`s.
std::shared_ptr<const plan_client> make_plan_client();

/// All functions at one provider share what it perceives of the road.
std::shared_ptr<offloading::provider_service>
make_planning_at_provider(planning_world_ptr world,
                          offloading::provider_context provider);

} // namespace sofof::actors
