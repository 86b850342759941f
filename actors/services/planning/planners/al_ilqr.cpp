// Planner "al_ilqr": optimal control.
#include "actors/services/planning/planner_options.hpp"
#include "planners/trajectory/spatial_planner.hpp"

#include <utility>

namespace sofof::actors {

planner_entry planner_al_ilqr() {
  return [](const planner_options& options, planners::route_profile_ptr along,
            bool remote) -> std::unique_ptr<planners::trajectory_planner> {
    return std::make_unique<planners::spatial_planner>(
        std::move(along), options.style,
        remote ? options.provider : options.onboard);
  };
}

} // namespace sofof::actors
