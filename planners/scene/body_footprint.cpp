// The outline of a body, point by point, along a way.
#include "planners/scene/body_footprint.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

/// Outlines are measured at points this far apart at most, m: a side between
/// two of them bulges less than 7 cm into a lane that bends with 12 m radius.
constexpr auto outline_m = 2.6;

/// Curvature changes by no more than this beneath a car, 1/m.
constexpr auto curvature_change_1pm = 0.05;

} // namespace

std::optional<body_footprint> measure_body(const world::route& way,
                                           const track& x,
                                           const where_to_look& where) {
  assert(where.within_m > 0 && x.length_m > 0);
  const auto& line = way.path();
  const auto on = line.project(x.centre(), where.guess_m, where.within_m);
  const auto here = line.at(on.s_m);
  const auto turned_rad = x.heading_rad - here.heading_rad;
  const auto c = std::cos(turned_rad), s = std::sin(turned_rad);
  constexpr auto infinity = std::numeric_limits<double>::infinity();
  body_footprint print{infinity,
                       -infinity,
                       infinity,
                       -infinity,
                       c,
                       x.speed_along_mps(here.heading_rad),
                       way.half_width_m(on.s_m)};

  // Most stay in their own lanes, by far.
  const auto wide_m = std::max(print.half_lane_m, where.corridor_m);
  const auto bulge_m = (std::abs(here.curvature_1pm) + curvature_change_1pm)
                       * (x.length_m * x.length_m + x.width_m * x.width_m) / 4;
  const auto across_m =
      (std::abs(s) * x.length_m + std::abs(c) * x.width_m) / 2;
  if (std::abs(on.d_m) - across_m - bulge_m > wide_m)
    return {};

  const auto stretch = 1 / std::max(0.2, 1 - here.curvature_1pm * on.d_m);
  const point ahead{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  const point left{-ahead.y_m, ahead.x_m};
  const auto add = [&](double along_m, double left_m) {
    const auto guess_m = on.s_m + stretch * (c * along_m - s * left_m);
    const auto p = line.project(x.centre() + along_m * ahead + left_m * left,
                                guess_m, where.within_m);
    print.from_m = std::min(print.from_m, p.s_m);
    print.to_m = std::max(print.to_m, p.s_m);
    print.low_m = std::min(print.low_m, p.d_m);
    print.high_m = std::max(print.high_m, p.d_m);
  };
  const auto pieces_along = std::ceil(x.length_m / outline_m);
  const auto pieces_across = std::ceil(x.width_m / outline_m);
  assert(pieces_along >= 1 && pieces_across >= 1);
  for (const auto side : {-0.5, 0.5}) {
    for (auto i = 0.0; i <= pieces_along; ++i)
      add((i / pieces_along - 0.5) * x.length_m, side * x.width_m);
    for (auto i = 1.0; i < pieces_across; ++i)
      add(side * x.length_m, (i / pieces_across - 0.5) * x.width_m);
  }
  if (print.low_m >= wide_m || print.high_m <= -wide_m)
    return {};
  assert(print.from_m <= print.to_m && print.low_m <= print.high_m);
  return print;
}

} // namespace sofof::planners
