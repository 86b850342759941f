// Ranks of a junction's lanes from who yields to whom.
#pragma once

#include "maps/source_map.hpp"
#include "maps/xml_file.hpp"
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace sofof::maps {

/// Of lanes by their names, into a list of them.
using lane_numbers = std::unordered_map<std::string, std::size_t>;

/// Ranks the lanes in each junction: as many as the longest chain of others
/// that go before it, one after the other. SUMO's `response` of a connection
/// says to whom it yields, the last character standing for the first lane of
/// `intLanes`. Where each yields to the next in a circle, as with right before
/// left, the chain ends where it would begin again.
void rank_lanes(const xml_file& net, std::vector<source_lane>& lanes,
                const lane_numbers& index);

} // namespace sofof::maps
