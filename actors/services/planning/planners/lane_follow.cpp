// Planner "lane_follow": a simple one, the same on both sides.
#include "planners/trajectory/lane_follow.hpp"

#include "actors/services/planning/planner_options.hpp"

#include <utility>

namespace sofof::actors {

planner_entry planner_lane_follow() {
  return [](const planner_options& options, planners::route_profile_ptr along,
            bool) -> std::unique_ptr<planners::trajectory_planner> {
    return std::make_unique<planners::lane_follow>(std::move(along),
                                                   options.style);
  };
}

} // namespace sofof::actors
