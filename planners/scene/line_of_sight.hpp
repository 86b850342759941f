// Which lines of sight the buildings of a map leave free.
#pragma once

#include "base/cell_grid.hpp"
#include "base/geometry.hpp"
#include "world/roads/road_map.hpp"

#include <span>
#include <vector>

namespace sofof::planners {

/// @returns whether the segment from `a` to `b` meets a rectangle.
bool crosses(point a, point b, const oriented_box& box);

/// The buildings of a map, as what hides bodies from sensors.
class line_of_sight {
public:
  /// @throws std::invalid_argument for a building that is no simple polygon.
  explicit line_of_sight(std::span<const world::building> buildings = {});

  /// @returns whether the segment from `eye` to `p` meets no building. A
  /// building in which the eye stands hides nothing.
  bool is_free(point eye, point p) const;

private:
  struct house {
    polygon shape;
    point middle;
    double radius_m; // no corner is farther from the middle
  };

  std::vector<house> houses_;
  cell_grid cells_; // of the middles
  double largest_m_ = 0;
};

} // namespace sofof::planners
