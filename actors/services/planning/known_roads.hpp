// What all planners of a run share of the map.
#pragma once

#include "planners/scene/lane_network.hpp"
#include "planners/speed/route_profile.hpp"

#include <map>
#include <memory>
#include <mutex>

namespace sofof::actors {

/// Everything is found once, by whoever needs it first. For several threads:
/// vehicles make their planners in their own.
class known_roads {
public:
  known_roads(const world::road_map& map,
              const planners::comfort_limits& style);

  const std::shared_ptr<const planners::lane_network>& lanes() const {
    return lanes_;
  }

  planners::route_profile_ptr profile(const world::route_ptr& way);

private:
  std::shared_ptr<const planners::lane_network> lanes_;
  planners::comfort_limits style_;
  std::mutex mutex_;
  // Each keeps its route, so that no other takes its place in memory.
  std::map<const world::route*, planners::route_profile_ptr> profiles_;
};

} // namespace sofof::actors
