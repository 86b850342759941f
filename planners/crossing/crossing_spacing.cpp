// What vehicles at a crossing leave between them.
#include "planners/crossing/crossing_spacing.hpp"

#include "planners/crossing/window_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

constexpr auto at_any_time = std::numeric_limits<double>::infinity();

/// A drive that just keeps to windows may be out by so much.
constexpr double window_rounding_s = 0.05;

/// A vehicle that is close behind another keeps at least this, m, ...
constexpr double closest_behind_m = 1;

/// ... which is all that counts where it could not stop any more, braking so.
constexpr double brakes_mps2 = 1.75, spare_way_m = 3;

double braking_way_m(double speed_mps) {
  return spare_way_m + speed_mps * speed_mps / (2 * brakes_mps2);
}

} // namespace

double crossing_spacing::left_m(const approach& x) const {
  return ways_[x.at.way].lane_ends_m - x.at.middle_m;
}

bool crossing_spacing::is_ahead(const approach& a, const approach& b) const {
  return ways_[a.at.way].lane == ways_[b.at.way].lane && left_m(a) < left_m(b);
}

kept_apart crossing_spacing::gap(const approach& first,
                                 const approach& then) const {
  return ways_.follow(first.at.way, then.at.way)
             ? kept_apart{margins_.following_s, margins_.following_m}
             : kept_apart{margins_.crossing_s, 0};
}

double crossing_spacing::lag_s(const approach& first, const approach& then) {
  const auto& a = first.motion.empty() ? first.alone : first.motion;
  return delay_s(ways_.meet(first.at.way, then.at.way), a, then.alone,
                 gap(first, then))
         + then.alone.time_s(ways_[then.at.way].enters_m)
         - a.time_s(ways_[first.at.way].enters_m);
}

std::optional<order_problem::closure>
crossing_spacing::closure(const approach& fixed, const approach& then) {
  assert(!fixed.motion.empty() && !then.alone.empty());
  const auto lag = lag_s(fixed, then);
  if (!std::isfinite(lag) || is_ahead(then, fixed))
    return std::nullopt;
  const auto to_s = fixed.motion.time_s(ways_[fixed.at.way].enters_m) + lag;
  if (is_ahead(fixed, then))
    return order_problem::closure{-at_any_time, to_s};
  // The fixed one would have to come later by so much, if positive.
  const auto late_s = delay_s(ways_.meet(then.at.way, fixed.at.way), then.alone,
                              fixed.motion, gap(then, fixed));
  const auto from_s = then.alone.time_s(ways_[then.at.way].enters_m) - late_s;
  if (!(from_s < to_s))
    return std::nullopt;
  assert(std::isfinite(to_s));
  return order_problem::closure{from_s, to_s};
}

void crossing_spacing::go_after(const approach& first, const approach& x,
                                place_windows& own) {
  assert(!first.motion.empty());
  const auto& meet = ways_.meet(first.at.way, x.at.way);
  const auto apart = gap(first, x);
  const auto is_one_lane = ways_[first.at.way].lane == ways_[x.at.way].lane;
  assert(own.earliest_s.size() == own.latest_s.size());
  const auto stop_m = braking_way_m(x.is->speed_mps);
  for (std::size_t k = 1; k < own.earliest_s.size(); ++k) {
    const auto way_m = static_cast<double>(k) * window_drive::step_m;
    const auto is_close = is_one_lane && way_m < stop_m;
    const auto cleared_m =
        meet.cleared_m(x.at.middle_m + way_m)
        + (is_close ? std::min(closest_behind_m, apart.by_m) : apart.by_m);
    if (std::isfinite(cleared_m) && cleared_m > first.motion.begins_m())
      own.earliest_s[k] =
          std::max(own.earliest_s[k], first.motion.time_s(cleared_m)
                                          + (is_close ? 0 : apart.by_s)
                                          - window_rounding_s);
  }
}

void crossing_spacing::go_before(const approach& then, const approach& x,
                                 place_windows& own) {
  assert(!then.motion.empty());
  const auto& meet = ways_.meet(x.at.way, then.at.way);
  assert(!own.latest_s.empty());
  const auto apart = gap(x, then);
  for (auto at_m = then.motion.begins_m(); at_m < then.motion.ends_m();
       at_m += window_drive::step_m) {
    const auto left_m = meet.cleared_m(at_m) + apart.by_m - x.at.middle_m;
    if (!std::isfinite(left_m) || left_m <= 0)
      continue;
    const auto k =
        static_cast<std::size_t>(std::ceil(left_m / window_drive::step_m));
    if (k < own.latest_s.size())
      own.latest_s[k] =
          std::min(own.latest_s[k],
                   then.motion.time_s(at_m) - apart.by_s + window_rounding_s);
  }
  for (auto k = own.latest_s.size() - 1; k-- > 0;)
    own.latest_s[k] = std::min(own.latest_s[k], own.latest_s[k + 1]);
}

} // namespace sofof::planners
