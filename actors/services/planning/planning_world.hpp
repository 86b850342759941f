// What planners of one run share, in vehicles and at providers.
#pragma once

#include "actors/services/planning/known_others.hpp"
#include "actors/services/planning/known_roads.hpp"
#include "actors/services/planning/planner_options.hpp"
#include "base/time.hpp"
#include "messages/v2x/georeference.hpp"
#include "planners/safety/rss.hpp"
#include "planners/scene/scene_interpreter.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <memory>

namespace sofof::actors {

/// The streets, and how to plan on them.
struct planning_world {
  world::streets_ptr streets;
  messages::georeference_ptr where;
  world::vehicle_params car{};
  bool crossings_granted = true;
  world::sensor_params eyes{}; ///< Of each vehicle.
  planner_options options;
  std::shared_ptr<known_roads> roads;
  planners::rss_assumptions rss{}; ///< Of the vehicle and of others.
  /// In a chain, the functions that run at one provider.
  std::shared_ptr<functions_beside> beside =
      std::make_shared<functions_beside>();
  /// At home, vehicles brake as RSS assumes it of them while their scene is not
  /// safe under this response time; 0: not for that reason.
  duration proper_response{};

  /// @returns how a vehicle looks at the others.
  planners::scene_params look() const {
    planners::scene_params how;
    how.judges_crossings = !crossings_granted;
    how.sees_opposite_m = eyes.range_m;
    how.houses = &roads->houses();
    return how;
  }
};

using planning_world_ptr = std::shared_ptr<const planning_world>;

} // namespace sofof::actors
