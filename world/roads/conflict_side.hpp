// The conflicts of a map, as each lane sees them.
#pragma once

#include "world/roads/road_map.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sofof::world {

/// One conflict, seen from one of its two lanes. Conflict number n has the
/// sides 2n (lane a) and 2n + 1 (lane b).
struct conflict_side {
  conflict::kind how = conflict::kind::crossing;
  std::uint32_t side = 0;
  double from_m = 0, to_m = 0; ///< Arc length on the own lane.
  std::size_t other_lane = 0;
  double other_from_m = 0, other_to_m = 0; ///< On the other lane.
  int rank = 0;                            ///< Of the own lane.
};

/// Of each lane, in order of the map's conflicts.
using conflict_sides = std::vector<std::vector<conflict_side>>;

conflict_sides list_encounters(const road_map& map);

} // namespace sofof::world
