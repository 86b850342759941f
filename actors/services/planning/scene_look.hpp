// How late a vehicle may respond to what it sees itself, or is told.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <optional>

namespace sofof::actors {

/// @param latest  The vehicle's newest input.
/// @returns nothing if that is no `plan_request`, or its route is not known.
std::optional<offloading::safe_response>
look_at(const messages::service_input& latest, const planning_world& world);

/// The same; in a chain for the scene that goes into planning as well: the
/// shorter time counts.
std::optional<offloading::safe_response>
look_at_all(const messages::service_input& latest, const planning_world& world);

} // namespace sofof::actors
