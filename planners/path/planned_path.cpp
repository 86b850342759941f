// Reading a path between its knots.
#include "planners/path/planned_path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// The knot that so many steps lead to, at most `last`; 0 for what is no
/// number.
std::size_t knot_at(double steps, double last) {
  return steps > 0 ? static_cast<std::size_t>(std::min(steps, last)) : 0;
}

} // namespace

std::size_t planned_path::knot_before(double way_m) const {
  assert(!empty() && ds_m > 0);
  // Knots are about ds apart: begin with that guess.
  auto k = knot_at(way_m / ds_m, size - 2);
  while (k > 0 && knots[k].way_m > way_m)
    --k;
  while (k + 2 < static_cast<std::size_t>(size) && knots[k + 1].way_m <= way_m)
    ++k;
  assert(k + 1 < static_cast<std::size_t>(size));
  return k;
}

double planned_path::s_m(double way_m) const {
  const auto k = knot_before(way_m);
  const auto &a = knots[k], &b = knots[k + 1];
  assert(a.way_m < b.way_m); // ways rise from knot to knot
  const auto share = (way_m - a.way_m) / (b.way_m - a.way_m);
  return start_s_m + ds_m * (static_cast<double>(k) + share);
}

double planned_path::way_m(double s_m) const {
  assert(!empty() && ds_m > 0);
  const auto steps = (s_m - start_s_m) / ds_m;
  const auto k = knot_at(steps, size - 2);
  const auto &a = knots[k], &b = knots[k + 1];
  return a.way_m + (steps - static_cast<double>(k)) * (b.way_m - a.way_m);
}

planned_path::between planned_path::find(double s_m) const {
  assert(!empty() && size <= capacity);
  assert(ds_m > 0);
  const auto steps = (s_m - start_s_m) / ds_m;
  const auto k = knot_at(steps, size - 2);
  return {knots[k], knots[k + 1],
          std::clamp(steps - static_cast<double>(k), 0.0, 1.0)};
}

double planned_path::curvature_1pm(double s_m) const {
  const auto [a, b, x] = find(s_m);
  return std::lerp(a.x.curvature_1pm, b.x.curvature_1pm, x);
}

double planned_path::sharpest_1pm(double s_m) const {
  const auto [a, b, x] = find(s_m);
  const auto& nearest = x < 0.5 ? a : b;
  return std::max(std::abs(nearest.x.curvature_1pm),
                  std::abs(std::lerp(a.x.curvature_1pm, b.x.curvature_1pm, x)));
}

planned_path::place planned_path::at_s(double s_m) const {
  const auto [a, b, x] = find(s_m);
  // Way per reference way times the sine of the heading is the offset's slope.
  const auto stretch = (b.way_m - a.way_m) / ds_m;
  assert(stretch > 0); // it leads along the line, and not across
  const auto from = stretch * a.sine, to = stretch * b.sine;
  const auto rise = (b.x.d_m - a.x.d_m) / ds_m;
  const auto rest = 1 - x;
  const auto d = a.x.d_m * rest * rest * (1 + 2 * x)
                 + b.x.d_m * x * x * (3 - 2 * x)
                 + ds_m * x * rest * (from * rest - to * x);
  const auto slope =
      6 * x * rest * rise + from * rest * (1 - 3 * x) - to * x * (2 - 3 * x);
  assert(std::isnan(x) || std::isfinite(d));
  return {s_m,
          {d, std::asin(std::clamp(slope / stretch, -1.0, 1.0)),
           std::lerp(a.x.curvature_1pm, b.x.curvature_1pm, x)}};
}

} // namespace sofof::planners
