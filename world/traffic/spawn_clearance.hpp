// Whether a vehicle may appear on the road without surprising anybody.
#pragma once

#include "world/roads/road_body.hpp"

#include <span>

namespace sofof::world {

/// @param place      Where it would appear.
/// @param speed_mps  How fast, ≥ 0.
/// @param others     Who is on the road.
/// @returns whether all middles are more than 12 m apart, and everybody who
/// does not drive away from the other has the way, besides, to hesitate for a
/// second and then brake at 2 m/s². Cautious: it does not ask who drives where.
bool is_free(const oriented_box& place, double speed_mps,
             std::span<const road_body> others);

} // namespace sofof::world
