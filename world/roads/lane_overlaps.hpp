// Lanes that lie upon each other without following from each other: a map is
// drawn by people.
#pragma once

#include "world/roads/road_map.hpp"

#include <cstddef>
#include <vector>

namespace sofof::world {

/// A stretch on which two lanes run side by side, closer than cars are wide,
/// though neither begins nor ends with the other.
struct lane_overlap {
  std::size_t lane_a = 0, lane_b = 0; ///< Indices into the map's lanes.
  point at;                           ///< The middle of the stretch, m.
  double length_m = 0;                ///< On the first lane.
  bool oncoming = false;
};

/// @returns stretches of more than 10 m in the order of the map's conflicts;
/// lanes that cross each other are none.
std::vector<lane_overlap> lane_overlaps(const road_map& map);

} // namespace sofof::world
