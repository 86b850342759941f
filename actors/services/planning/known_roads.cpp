// What all planners of a run share of the map.
#include "actors/services/planning/known_roads.hpp"

namespace sofof {

known_roads::known_roads(const road_map& map, const comfort_limits& style)
    : lanes_{std::make_shared<const lane_network>(map)}, style_{style} {}

route_profile_ptr known_roads::profile(const route_ptr& way) {
  const std::lock_guard lock{mutex_};
  auto& profile = profiles_[way.get()];
  if (!profile)
    profile = std::make_shared<const route_profile>(way, style_);
  return profile;
}

} // namespace sofof
