// Draws the lanes of a source so that a car can follow them.
#pragma once

#include "world/roads/lane.hpp"

#include "maps/source_map.hpp"
#include <string>
#include <vector>

namespace sofof::maps {

/// A car of ours bends its path by 0.2 1/m at most; a spline through points of
/// a curve bends somewhat more than the curve.
inline constexpr auto sharpest_drivable_1pm = 0.195;

/// A lane with its smooth centre line.
struct drawn_lane {
  world::lane is;
  double sharpest_1pm = 0; ///< Its curvature at most, without a sign.

  bool is_drivable() const { return sharpest_1pm <= sharpest_drivable_1pm; }
};

/// Lanes that follow each other meet in one point and direction. Turns in
/// junctions begin up to 3 m before these and end up to 3 m behind, on the
/// lanes beside; half widths in turns hold what a car swings out.
/// @param map  Tidy.
std::vector<drawn_lane> draw_lanes(const source_map& map);

} // namespace sofof::maps
