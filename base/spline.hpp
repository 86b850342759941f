// A cubic spline through points of the plane, over chord length.
#pragma once

#include "base/geometry.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sofof {

/// One cubic piece of a plane curve over a parameter u in [0, chord_m].
struct cubic_piece {
  point a, b, c, d; ///< a + b u + c u^2 + d u^3, m.
  double chord_m = 0;

  point at(double u) const { return a + u * (b + u * (c + u * d)); }
  point slope(double u) const { return b + u * (2 * c + 3 * u * d); }
  point bend(double u) const { return 2 * c + 6 * u * d; }

  /// @returns the length of the curve between two parameters, m
  /// (Gauss-Legendre with three nodes: for short intervals).
  double length_m(double from, double to) const;
};

/// Fits a C2 spline: straight ends (natural) when open, periodic when closed.
/// @param points  At least 2 (open) or 3 (closed), no two neighbours equal,
///                m. A closed spline returns from the last to the first.
/// @returns one piece from each point to the next.
/// @throws std::invalid_argument otherwise.
std::vector<cubic_piece> fit_spline(std::span<const point> points, bool closed);

} // namespace sofof
