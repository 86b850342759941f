// Which planner plans, and how.
#pragma once

#include "actors/services/planning/known_roads.hpp"
#include "actors/services/planning/planner_entry.hpp"
#include "base/options/option_visitor.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/roads/route.hpp"

#include <memory>
#include <string>

namespace sofof::actors {

/// Of both sides; only the optimal planner plans differently at a provider.
struct planner_options {
  std::string name = "al_ilqr"; ///< Or "lane_follow", a simple one.
  planners::comfort_limits style;
  planners::spatial_params onboard;
  planners::spatial_params provider{
      .horizon_m = 125, .step_m = 0.5, .candidates = 16, .alternations = 2};

  void visit_options(option_visitor& s);

  std::unique_ptr<planners::trajectory_planner>
  make(const world::route_ptr& way, known_roads& roads, bool remote) const;
};

} // namespace sofof::actors
