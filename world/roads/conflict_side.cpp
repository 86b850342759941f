// The conflicts of a map, as each lane sees them.
#include "world/roads/conflict_side.hpp"

namespace sofof::world {

conflict_sides list_encounters(const road_map& map) {
  conflict_sides all(map.lanes().size());
  std::uint32_t side = 0;
  for (const auto& c : map.conflicts()) {
    all[c.lane_a].push_back({c.how, side++, c.from_a_m, c.to_a_m, c.lane_b,
                             c.from_b_m, c.to_b_m, map.lanes()[c.lane_a].rank});
    all[c.lane_b].push_back({c.how, side++, c.from_b_m, c.to_b_m, c.lane_a,
                             c.from_a_m, c.to_a_m, map.lanes()[c.lane_b].rank});
  }
  return all;
}

} // namespace sofof::world
