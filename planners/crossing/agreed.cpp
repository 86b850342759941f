// What a planner keeps to of a drive that was agreed on.
#include "planners/crossing/agreed.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::planners {
namespace {

/// Slower than this a drive waits: so little way in so many points.
constexpr std::size_t while_points = 4;
constexpr double waits_below_mps = 0.15;
/// It counts from so far before the line on.
constexpr double counts_before_line_m = 2;
constexpr double here_m = 0.7, stands_mps = 0.3, goes_soon_s = 0.05;

} // namespace

std::optional<agreed_drive> agreed(const crossing_view& with, time_point now,
                                   const agreeing_car& car) {
  if (with.drive.empty())
    return std::nullopt;
  agreed_drive a;
  const auto& all = with.drive.points;
  const auto since_s = to_seconds(with.drive.start - now);
  auto goes_s = -1.0;
  for (std::size_t k = 0; k + while_points < all.size(); ++k) {
    const auto& last = all[k + while_points];
    if (all[k].s_m < car.s_m - here_m || last.s_m - all[k].s_m > waits_below_mps * (last.t_s - all[k].t_s))
      continue;
    if (a.waits_at_m && all[k].s_m > *a.waits_at_m + 0.3)
      break;
    a.waits_at_m = all[k].s_m;
    goes_s = since_s + last.t_s;
  }
  if (since_s > 0 && car.speed_mps < stands_mps && all[0].s_m > car.s_m - 0.5) {
    a.waits_at_m = car.s_m;
    goes_s = since_s;
  }
  if (a.waits_at_m && goes_s > goes_soon_s)
    return a;
  a.waits_at_m.reset();
  for (const auto& p : all)
    if (p.s_m > with.line_m - car.front_m - counts_before_line_m && (a.axle.empty() || p.s_m > a.axle.back().s_m + 0.05))
      a.axle.push_back({p.s_m, since_s + p.t_s});
  return a;
}

std::optional<double> waiting_line_m(const crossing_view& with,
                                     const agreeing_car& car) {
  constexpr double stops_mps2 = 2.5, decides_s = 0.5, spare_m = 1,
                   beyond_m = 0.3;
  const auto left_m = with.line_m - car.s_m - car.front_m;
  const auto v = car.speed_mps;
  if (with.binds || with.drive.empty() || left_m <= 0
      || left_m > v * (decides_s + v / (2 * stops_mps2)) + spare_m)
    return std::nullopt;
  return with.line_m + beyond_m;
}

} // namespace sofof::planners
