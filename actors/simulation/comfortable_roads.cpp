// What is known of the routes of cars, shared by all on one route.
#include "actors/simulation/comfortable_roads.hpp"

#include <memory>

namespace sofof::actors {

planners::route_profile_ptr comfortable_roads::of(const world::route_ptr& way) {
  auto& road = known_[way.get()];
  if (!road)
    road = std::make_shared<const planners::route_profile>(
        way, planners::comfort_limits{});
  return road;
}

} // namespace sofof::actors
