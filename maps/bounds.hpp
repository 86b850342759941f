// Lanes that are given by their left and right bounds.
#pragma once

#include "base/geometry.hpp"

#include <span>
#include <vector>

namespace sofof::maps {

/// The middle of a lane, and how wide it is at its narrowest.
struct lane_middle {
  std::vector<point> centre;
  double half_width_m = 0;
};

/// @param left, right  In driving order, at least 2 points each, m.
/// @returns means of places at equal shares of both bounds' lengths, at most
/// 5 m apart.
lane_middle middle_of(std::span<const point> left,
                      std::span<const point> right);

} // namespace sofof::maps
