// Reading a plan between its points.
#include "world/vehicle/trajectory.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {
namespace {

/// Plans with other steps are no plans.
constexpr double min_step_s = 1e-3;
constexpr double max_step_s = 10;
constexpr double step_tolerance = 1e-6;
/// No road vehicle gets beyond these; they keep all sums finite.
constexpr double largest_speed_mps = 200;
constexpr double largest_length_m = 1e9;
constexpr double largest_heading_rad = 1e6; // many laps, unwrapped
constexpr double largest_curvature_1pm = 10;
constexpr double largest_accel_mps2 = 1000;

/// The cubic with values y0, y1 and slopes m0, m1 (per unit of time) at the
/// ends of an interval of length h; x in [0, 1].
double hermite(double y0, double m0, double y1, double m1, double h, double x) {
  const auto rest = 1 - x;
  return y0 * rest * rest * (1 + 2 * x) + y1 * x * x * (3 - 2 * x)
         + h * x * rest * (m0 * rest - m1 * x);
}

double mix(double low, double high, double share) {
  return low + share * (high - low);
}

trajectory_point between(const trajectory_point& a, const trajectory_point& b,
                         double x) {
  const auto h = b.t_s - a.t_s;
  const auto way = b.s_m - a.s_m;
  trajectory_point p;
  p.t_s = mix(a.t_s, b.t_s, x);
  p.s_m = hermite(a.s_m, a.speed_mps, b.s_m, b.speed_mps, h, x);
  p.speed_mps = std::max(
      0.0, hermite(a.speed_mps, a.accel_mps2, b.speed_mps, b.accel_mps2, h, x));
  p.accel_mps2 = mix(a.accel_mps2, b.accel_mps2, x);

  const auto along = way > 1e-9 ? (p.s_m - a.s_m) / way : x;
  p.heading_rad = mix(a.heading_rad, b.heading_rad, along);
  p.curvature_1pm = mix(a.curvature_1pm, b.curvature_1pm, along);
  // The arc lies on the outer side of its chord.
  const auto chord = b.at - a.at;
  const auto bulge =
      0.5 * along * (1 - along) * (b.heading_rad - a.heading_rad);
  p.at = a.at + along * chord + bulge * point{chord.y_m, -chord.x_m};
  return p;
}

} // namespace

time_point trajectory::end() const {
  return empty() ? start : start + from_seconds(points.back().t_s);
}

bool trajectory::is_sound() const {
  if (points.size() < 2 || points.front().t_s != 0)
    return false;
  const auto step_s = points[1].t_s;
  if (!(step_s >= min_step_s && step_s <= max_step_s))
    return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    const auto due_s = static_cast<double>(i) * step_s;
    // Comparisons with NaN are false.
    if (!(std::abs(p.t_s - due_s) <= step_tolerance * step_s && p.speed_mps >= 0
          && p.speed_mps <= largest_speed_mps
          && std::abs(p.s_m) <= largest_length_m
          && std::abs(p.at.x_m) <= largest_length_m
          && std::abs(p.at.y_m) <= largest_length_m
          && std::abs(p.heading_rad) <= largest_heading_rad
          && std::abs(p.curvature_1pm) <= largest_curvature_1pm
          && std::abs(p.accel_mps2) <= largest_accel_mps2))
      return false;
  }
  return true;
}

trajectory_point trajectory::at(double t_s) const {
  assert(!empty());
  if (t_s <= 0 || points.size() == 1)
    return points.front();
  if (t_s >= points.back().t_s)
    return points.back();
  // Signed numbers are converted in one instruction.
  const auto last = static_cast<std::ptrdiff_t>(points.size()) - 2;
  const auto steps = t_s / points[1].t_s;
  const auto i = std::min(static_cast<std::ptrdiff_t>(steps), last);
  const auto* low = points.data() + i;
  return between(low[0], low[1],
                 std::clamp(steps - static_cast<double>(i), 0.0, 1.0));
}

trajectory rest_of(const trajectory& plan, time_point from) {
  if (plan.empty() || plan.start >= from)
    return plan;
  trajectory rest{from, {}};
  const auto step_s = plan.points.size() > 1 ? plan.points[1].t_s : 0;
  const auto passed_s = to_seconds(from - plan.start);
  for (auto t_s = 0.0; passed_s + t_s <= plan.points.back().t_s && step_s > 0;
       t_s = static_cast<double>(rest.points.size()) * step_s) {
    rest.points.push_back(plan.at(passed_s + t_s));
    rest.points.back().t_s = t_s;
  }
  return rest;
}

} // namespace sofof::world
