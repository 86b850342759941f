// Where a car is going to drive: offset, heading and curvature against a
// reference line, knot by knot.
#pragma once

#include "planners/ocp/series.hpp"
#include "planners/problems/path_model.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace sofof::planners {

/// A path along a reference line; knots are equidistant on the line. Beyond
/// its ends offset, heading and curvature stay as at them, and lengths go on
/// as between the two knots there. No heap, byte-wise copyable.
class planned_path {
public:
  /// Arc lengths of the line (`s`), and of the path itself from its first
  /// knot on (`way`).
  struct knot {
    path_state x;
    double sine = 0; ///< Of the heading.
    double way_m = 0;
  };
  struct place {
    double s_m = 0;
    path_state x;
  };

  static constexpr int capacity = ocp::most_steps + 2;

  double start_s_m = 0; ///< Of the first knot.
  double ds_m = 1;
  int size = 0; ///< Knots; at least 2, else there is no path.
  std::array<knot, capacity> knots{};

  bool empty() const { return size < 2; }
  double end_s_m() const { return start_s_m + (size - 1) * ds_m; }
  double length_m() const { return knots[last()].way_m; }

  /// Computes the rest of all knots from their states.
  /// @param line  κ of the reference line at an arc length, 1/m.
  template <class Line>
  void measure(const Line& line);

  /// From the one length to the other, linear between knots and beyond.
  double way_m(double s_m) const;
  double s_m(double way_m) const;

  /// Curvature is linear between knots; offset is a cubic that fits the
  /// headings at both ends, and heading is its slope.
  place at_s(double s_m) const;
  place at_way(double way_m) const { return at_s(s_m(way_m)); }

  double curvature_1pm(double s_m) const;

  /// @returns the largest |curvature| between here and the nearest knot.
  double sharpest_1pm(double s_m) const;

private:
  struct between {
    const knot& a;
    const knot& b;
    double share;
  };
  between find(double s_m) const;
  std::size_t last() const { return static_cast<std::size_t>(size - 1); }
  std::size_t knot_before(double way_m) const;
};

template <class Line>
void planned_path::measure(const Line& line) {
  assert(!empty() && size <= capacity);
  assert(ds_m > 0);
  const auto stretch = [&](std::size_t k) {
    auto& here = knots[k];
    here.sine = std::sin(here.x.heading_rad);
    const auto bend = line(start_s_m + static_cast<double>(k) * ds_m);
    return (1 - here.x.d_m * bend) / std::sqrt(1 - here.sine * here.sine);
  };
  knots[0].way_m = 0;
  auto before = stretch(0);
  for (std::size_t k = 1; k <= last(); ++k) {
    const auto here = stretch(k);
    assert(before > 0 && here > 0); // not beyond the line's centre of bend
    knots[k].way_m = knots[k - 1].way_m + ds_m * (before + here) / 2;
    before = here;
  }
}

} // namespace sofof::planners
