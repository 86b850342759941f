// What a provider perceives, once for all its services.
#pragma once

#include "actors/services/planning/edge_perception.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// @returns what this provider perceives of the road, the same for all services
/// that share a world; another one for each provider without an id.
std::shared_ptr<edge_perception>
perceived_at(const planning_world& world,
             const offloading::provider_context& provider);

} // namespace sofof::actors
