// How fast a route may be driven by what is seen of it.
#include "planners/speed/sight_limit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// A plan reckons with what comes in sight only after so long.
constexpr double reacts_after_s = 0.3;
/// From the middle of a car that is not seen yet to its rear.
constexpr double half_car_m = 2.55;
/// At a crossing that is never seen into, a car feels its way.
constexpr double groping_mps = 2.5;
/// Of firm braking; the rest is for what goes wrong.
constexpr double share_of_firm = 0.9;

/// The speed from which a car comes to rest within a way.
double speed_to_stop_mps(double way_m, const comfort_limits& style) {
  const auto a = share_of_firm * style.firm_decel_mps2();
  assert(a > 0);
  const auto reacts =
      std::sqrt(reacts_after_s * reacts_after_s + 2 * std::max(0.0, way_m) / a);
  return std::max(groping_mps, a * (reacts - reacts_after_s));
}

/// No faster before a corner than a car can stop there, until it sees who
/// comes.
void see_round(std::vector<double>& most_mps, const blind_corner& corner,
               const world::route& way, const comfort_limits& style) {
  constexpr double approach_m = 100;
  const auto size = static_cast<long>(most_mps.size());
  assert(size > 1 && corner.seen_from_m <= corner.line_m);
  assert(std::isfinite(corner.line_m));
  for (auto s_m = std::floor(corner.line_m - approach_m);
       s_m <= corner.seen_from_m; ++s_m) {
    auto i = std::lround(s_m);
    if (way.closed())
      i = (i % (size - 1) + size - 1) % (size - 1);
    else if (i < 0)
      continue;
    auto& most = most_mps[static_cast<std::size_t>(std::min(i, size - 1))];
    most = std::min(most, speed_to_stop_mps(corner.line_m - s_m, style));
  }
}

} // namespace

std::vector<double> sight_limits_mps(const world::route& way,
                                     const comfort_limits& style,
                                     const route_sight& sight,
                                     const lane_network* lanes) {
  std::vector<double> most_mps;
  assert(way.length_m() > 0 && style.standstill_gap_m >= 0);
  for (auto s_m = 0.0; s_m < way.length_m() + 1; ++s_m)
    most_mps.push_back(speed_to_stop_mps(
        sight.ahead_m(s_m) - half_car_m - style.standstill_gap_m, style));
  if (lanes)
    for (const auto& corner : sight.corners(*lanes))
      see_round(most_mps, corner, way, style);
  assert(most_mps.size() > 1);
  return most_mps;
}

} // namespace sofof::planners
