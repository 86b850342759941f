// What all planners of a run share of the map.
#pragma once

#include "planners/scene/known_way.hpp"
#include "planners/scene/lane_network.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/route_sight.hpp"
#include "planners/speed/route_profile.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace sofof::actors {

/// Everything is found once, by whoever needs it first. For several threads:
/// vehicles make their planners in their own.
class known_roads {
public:
  /// @param eyes    Those of a provider; vehicles have their own alone.
  /// @param judges  Crossings are judged, not granted.
  known_roads(const world::road_map& map, const planners::comfort_limits& style,
              const planners::eyes_on_road& eyes, bool judges);

  const std::shared_ptr<const planners::lane_network>& lanes() const {
    return lanes_;
  }

  const planners::line_of_sight& houses() const { return houses_; }

  planners::known_way_ptr way(const world::route_ptr& route);

  /// @param at_provider  It is for plans that are made there.
  planners::route_profile_ptr profile(const world::route_ptr& way,
                                      bool at_provider);

private:
  std::shared_ptr<const planners::lane_network> lanes_;
  planners::comfort_limits style_;
  planners::line_of_sight houses_;
  planners::eyes_on_road eyes_;
  bool judges_;
  std::mutex mutex_;
  // Each of both keeps its route, so that no other takes its place in memory.
  std::map<const world::route*, planners::known_way_ptr> ways_;
  std::map<std::pair<const world::route*, bool>, planners::route_profile_ptr>
      profiles_;
};

} // namespace sofof::actors
