// What a planner keeps to of a drive that was agreed on.
#include "planners/crossing/agreed.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::planners {
namespace {

/// A drive waits where it is slower than this over so many points.
constexpr std::size_t while_points = 4;
constexpr double waits_below_mps = 0.15;
/// Places so near to each other are one.
constexpr double same_wait_m = 0.3, next_place_m = 0.05;
/// A place is ahead, or the car is on it; who is slower than this stands there.
constexpr double here_m = 0.7, behind_m = 0.5, stands_mps = 0.3;
/// Who sets off so soon does not wait.
constexpr double goes_soon_s = 0.05;
/// Who is on the crossing keeps to what binds, or to nothing.
constexpr double on_it_m = 0.5;
/// When it comes to a place binds from so far before the line on.
constexpr double counts_before_line_m = 2;

/// How who drives as it was told stops at its line: it decides, then brakes.
constexpr double agreed_stops_mps2 = 2.5, decides_s = 0.5, agreed_spare_m = 1;
/// It stops there with its front beyond the line by so much at most.
constexpr double beyond_line_m = 0.3;

/// Where a drive waits, and until when, in seconds from now on.
struct waiting {
  double at_m, until_s;
};

/// @returns the first place ahead at which a drive waits.
std::optional<waiting> next_wait(const world::trajectory& drive, double since_s,
                                 const agreeing_car& car) {
  assert(!drive.empty() && std::isfinite(since_s));
  assert(std::isfinite(car.s_m) && car.speed_mps >= 0);
  const auto& all = drive.points;
  std::optional<waiting> found;
  for (std::size_t k = 0; k + while_points < all.size(); ++k) {
    const auto &first = all[k], &last = all[k + while_points];
    const auto rolls =
        last.s_m - first.s_m > waits_below_mps * (last.t_s - first.t_s);
    if (first.s_m < car.s_m - here_m || rolls)
      continue;
    if (found && first.s_m > found->at_m + same_wait_m)
      break;
    found = {first.s_m, since_s + last.t_s};
  }
  const auto sets_off_later = since_s > 0 && car.speed_mps < stands_mps
                              && all.front().s_m > car.s_m - behind_m;
  if (sets_off_later)
    found = {car.s_m, since_s};
  if (found && found->until_s <= goes_soon_s)
    found.reset();
  return found;
}

} // namespace

std::optional<agreed_drive> agreed(const crossing_view& with, time_point now,
                                   const agreeing_car& car) {
  assert(std::isfinite(car.s_m) && std::isfinite(with.line_m));
  assert(car.speed_mps >= 0 && car.front_m >= 0);
  const auto is_on_crossing = car.s_m + car.front_m > with.line_m + on_it_m;
  if (with.drive.empty() || (is_on_crossing && !with.binds))
    return std::nullopt;
  agreed_drive a;
  const auto since_s = to_seconds(with.drive.start - now);
  if (const auto wait = next_wait(with.drive, since_s, car)) {
    a.waits_at_m = wait->at_m;
    return a;
  }
  assert(!a.waits_at_m);
  a.binds_from_m = with.line_m - car.front_m - counts_before_line_m;
  for (const auto& p : with.drive.points)
    if (a.axle.empty() || p.s_m > a.axle.back().s_m + next_place_m)
      a.axle.push_back({p.s_m, since_s + p.t_s});
  return a;
}

std::optional<double> waiting_line_m(const crossing_view& with,
                                     const agreeing_car& car) {
  assert(car.speed_mps >= 0);
  const auto left_m = with.line_m - car.s_m - car.front_m;
  const auto v = car.speed_mps;
  const auto stopping_m =
      v * (decides_s + v / (2 * agreed_stops_mps2)) + agreed_spare_m;
  if (with.binds || with.drive.empty() || left_m <= 0 || left_m > stopping_m)
    return std::nullopt;
  return with.line_m + beyond_line_m;
}

} // namespace sofof::planners
