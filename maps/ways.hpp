// Ways through an imported network.
#pragma once

#include "maps/imported_map.hpp"
#include "maps/smooth_lanes.hpp"
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sofof::maps {

/// How lanes follow each other, as indices.
using followers = std::vector<std::vector<std::size_t>>;

followers followers_of(const std::vector<drawn_lane>& lanes);

/// Proposes ways, so that a map can be driven at once: from where lanes enter
/// the network, or from anywhere if none does, each along lanes that the ways
/// before it have used least, over drivable lanes only, to where the network
/// is left or 2.5 km have been driven. A way that comes round is closed.
/// @param most  How many.
std::vector<lane_route> propose_ways(const source_map& source,
                                     const std::vector<drawn_lane>& lanes,
                                     std::size_t most = 24);

/// Finds lanes for lists of edges. Nobody changes lanes: a way must lead from
/// each edge to the next.
class way_finder {
public:
  /// What it is given outlives it.
  way_finder(const source_map& source, const std::vector<drawn_lane>& lanes);

  /// @returns the way with the fewest lanes, of these the first one; nullopt if
  /// there is none, or if it needs a lane that no car can follow.
  std::optional<std::vector<std::string>>
  lanes_for(const source_route& route) const;

private:
  const source_map& source_;
  const std::vector<drawn_lane>& lanes_;
  followers next_;
  /// Lanes by the edge that is driven on them first, in order.
  std::unordered_map<std::string_view, std::vector<std::size_t>> by_edge_;
};

} // namespace sofof::maps
