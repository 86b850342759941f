// A smooth curve beside a polyline.
#pragma once

#include "base/geometry.hpp"

#include <span>
#include <vector>

namespace sofof::maps {

/// Where a curve begins and ends, and in which directions, as unit vectors.
struct curve_ends {
  point start, start_direction;
  point end, end_direction;
};

/// How far a curve may be from its source, and how sharply it may bend.
struct curve_limits {
  double off_m = 0.15;
  double curvature_1pm = 0.18;
};

struct fitted_curve {
  std::vector<point> points; ///< Both ends included.
  double sharpest_1pm = 0;   ///< Largest curvature, without a sign.
};

/// Smooths a polyline: least squares with a penalty on the third difference,
/// so that curvature changes slowly, and is none at the ends. The penalty is
/// the strongest that keeps the limits; where no penalty keeps both, the one
/// that bends least sharply.
/// @param source  At least 2 points, not all the same, m.
/// @returns points a metre or less apart.
fitted_curve fit_p_spline(std::span<const point> source, const curve_ends& ends,
                          const curve_limits& limits);

/// Leaves out points that a spline through the others does without: where the
/// curve turns by little they are up to 20 m apart.
std::vector<point> thinned(std::span<const point> curve);

} // namespace sofof::maps
