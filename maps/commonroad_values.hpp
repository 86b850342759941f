// Shapes, intervals and states as a CommonRoad file writes them.
#pragma once

#include "maps/commonroad_scene.hpp"
#include "maps/xml_file.hpp"
#include <string_view>
#include <vector>

namespace sofof::maps {

/// A rectangle: of a body in its own frame, or on the road.
struct shape_box {
  point middle;
  double heading_rad = 0, length_m = 0, width_m = 0;
};

/// Reads values of a file, and refuses what is none.
class commonroad_values {
public:
  /// @param file  Outlives this.
  explicit commonroad_values(const xml_file& file) : file_{file} {}

  const xml_file& file() const { return file_; }

  /// @returns the element inside that has to be there.
  pugi::xml_node need(pugi::xml_node at, const char* name) const;

  /// @returns the number that an element inside holds.
  double number(pugi::xml_node at, const char* name, double least = -1e7,
                double most = 1e7) const;

  /// @returns <x> and <y> of an element.
  point place(pugi::xml_node at) const;

  /// @returns all <point>s inside, at least `least`.
  std::vector<point> points(pugi::xml_node at, std::size_t least) const;

  /// @returns what an element says by <exact>, or by <intervalStart> and
  /// <intervalEnd>, in order.
  closed_interval interval(pugi::xml_node at, double least, double most) const;

  /// @returns the same of time, as whole steps.
  std::pair<time_step, time_step> steps(pugi::xml_node at) const;

  /// @returns the smallest rectangle along the x axis around all shapes in an
  /// element; a single rectangle as it is.
  shape_box box(pugi::xml_node shapes) const;

  /// @returns each rectangle, circle and polygon in an element.
  std::vector<scene_region> regions(pugi::xml_node at) const;

  /// @returns where a body is, at the middle of what is not exact.
  scene_body::state state(pugi::xml_node at) const;

private:
  scene_region region(pugi::xml_node shape) const;
  shape_box rectangle(pugi::xml_node shape) const;

  const xml_file& file_;
};

/// @returns the corners of a rectangle, in their order.
std::vector<point> corners_of(const shape_box& box);

} // namespace sofof::maps
