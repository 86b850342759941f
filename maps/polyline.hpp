// Measures on polylines.
#pragma once

#include "base/geometry.hpp"

#include "maps/p_spline.hpp"
#include <cstddef>
#include <span>
#include <vector>

namespace sofof::maps {

/// @param line  At least 1 point.
/// @param s_m   From its start on; clamped to its length.
point point_along(std::span<const point> line, double s_m);

/// Points along a line, each at least as far on as the one before: all of them
/// take as long as one walk.
class line_walk {
public:
  /// @param line  At least 1 point; outlives this.
  explicit line_walk(std::span<const point> line) : line_{line} {}

  /// @param s_m  From the line's start on; clamped to its length, and not less
  ///             than that of the call before.
  point to(double s_m);

private:
  std::span<const point> line_;
  std::size_t segment_ = 0;
  double begins_m_ = 0; // the segment
};

/// @returns the part of a line between two arc lengths, both of its length at
/// most.
std::vector<point> part_of(std::span<const point> line, double from_m,
                           double to_m);

/// @returns the line without points that are less than 5 cm from the one
/// before; both ends stay, if they are not the same.
std::vector<point> without_doubles(std::span<const point> line);

/// @returns the distance of a point from a line of at least 2 points, m.
double distance_to_m(point p, std::span<const point> line);

/// @returns the unit vector from the start of a line to where it is after two
/// metres, or at its end; none in particular for a line without length.
point direction_at_start(std::span<const point> line);
point direction_at_end(std::span<const point> line);

/// @returns by how much a line bends at an inner point, without a sign.
double bend_1pm(std::span<const point> line, std::size_t i);

/// @returns the largest of a curve, its directions at both ends included.
double sharpest_of(std::span<const point> curve, const curve_ends& ends);

} // namespace sofof::maps
