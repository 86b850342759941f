// What a file of actors/services/planning/planners defines: planner_NAME().
#pragma once

#include "planners/trajectory/trajectory_planner.hpp"

#include <memory>

namespace sofof::actors {

struct planner_options;

/// Makes a planner of this name along a route.
/// @param remote  Whether it plans at a provider.
using planner_entry = std::unique_ptr<planners::trajectory_planner> (*)(
    const planner_options& options, planners::route_profile_ptr along,
    bool remote);

} // namespace sofof::actors
