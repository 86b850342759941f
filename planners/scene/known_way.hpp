// What those who look round on a route know of it.
#pragma once

#include "planners/scene/lane_network.hpp"
#include "world/roads/unrolled_route.hpp"

#include <memory>
#include <vector>

namespace sofof::planners {

/// A route among the lanes of its map; the same for all who drive on it.
struct known_way {
  /// @param all  Lanes of the map that the route is on; not null.
  known_way(std::shared_ptr<const lane_network> all,
            const world::route_ptr& way);

  const world::route_ptr& route() const { return legs.on(); }

  std::shared_ptr<const lane_network> lanes;
  world::unrolled_route legs;
  std::vector<point> beads; ///< Along the way, equidistant.
  double bead_m = 0;        ///< From one to the next.
  double half_lane_m = 0;   ///< At its widest.
};

using known_way_ptr = std::shared_ptr<const known_way>;

} // namespace sofof::planners
