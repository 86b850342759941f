// What all planners of a run share of the map.
#include "actors/services/planning/known_roads.hpp"

#include "planners/speed/sight_limit.hpp"

namespace sofof::actors {

known_roads::known_roads(const world::road_map& map,
                         const planners::comfort_limits& style,
                         const planners::eyes_on_road& eyes, bool judges)
    : lanes_(std::make_shared<const planners::lane_network>(map)),
      style_(style), houses_{map.buildings()}, eyes_{eyes}, judges_{judges} {}

planners::known_way_ptr known_roads::way(const world::route_ptr& route) {
  const std::lock_guard lock{mutex_};
  auto& known = ways_[route.get()];
  if (!known)
    known = std::make_shared<const planners::known_way>(lanes_, route);
  return known;
}

planners::route_profile_ptr known_roads::profile(const world::route_ptr& way,
                                                 bool at_provider) {
  // Without sensors beside the road a provider sees what vehicles see.
  at_provider = at_provider && !eyes_.roadside.empty();
  const std::lock_guard lock{mutex_};
  auto& profile = profiles_[{way.get(), at_provider}];
  if (!profile) {
    auto eyes = eyes_;
    if (!at_provider)
      eyes.roadside.clear();
    const planners::route_sight sight{way, houses_, eyes};
    const auto most_mps = planners::sight_limits_mps(
        *way, style_, sight, judges_ ? lanes_.get() : nullptr);
    profile =
        std::make_shared<const planners::route_profile>(way, style_, most_mps);
  }
  return profile;
}

} // namespace sofof::actors
