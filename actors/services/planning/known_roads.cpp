// What all planners of a run share of the map.
#include "actors/services/planning/known_roads.hpp"

namespace sofof::actors {

known_roads::known_roads(const world::road_map& map,
                         const planners::comfort_limits& style)
    : lanes_(std::make_shared<const planners::lane_network>(map)),
      style_(style) {}

planners::route_profile_ptr known_roads::profile(const world::route_ptr& way) {
  const std::lock_guard lock{mutex_};
  auto& profile = profiles_[way.get()];
  if (!profile)
    profile = std::make_shared<const planners::route_profile>(way, style_);
  return profile;
}

} // namespace sofof::actors
