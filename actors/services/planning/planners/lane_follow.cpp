// Planner "lane_follow": a simple one, the same on both sides.
#include "planners/trajectory/lane_follow.hpp"

#include "actors/services/planning/planner_options.hpp"

#include <utility>

namespace sofof {

planner_entry planner_lane_follow() {
  return [](const planner_options& options, route_profile_ptr along,
            bool) -> std::unique_ptr<trajectory_planner> {
    return std::make_unique<lane_follow>(std::move(along), options.style);
  };
}

} // namespace sofof
