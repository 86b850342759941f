// A lane: where it runs, how fast it may be driven, and what follows it.
#pragma once

#include "base/geometry.hpp"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace sofof::world {

/// From `from_m` (arc length on its lane) on, this speed is allowed.
struct speed_zone {
  double from_m = 0;
  double limit_mps = 0;
};

/// One lane, driven in the order of its points. Its arc length is that of the
/// smooth path through them.
struct lane {
  std::string name;
  std::vector<point> centre; ///< m, east-north; at least 2.
  double half_width_m = 1.75;
  std::vector<speed_zone> limits; ///< Rising `from_m`, the first at 0.
  std::vector<std::string> next;  ///< Names of the lanes that follow.
  int rank = 0; ///< Right of way: 0 goes before 1 goes before 2.
  /// The lane beside it on the left that is driven the other way, and that may
  /// be used to pass what blocks this one; empty: none.
  std::string opposite;
};

/// Lanes by their names: indices into those of a map.
using lane_index = std::unordered_map<std::string, std::size_t>;

} // namespace sofof::world
