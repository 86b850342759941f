// How a car ahead goes on.
#include "planners/speed/speed_constraints.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

double speed_constraints::follower::way_left_m() const {
  if (lead.speed_mps <= 0)
    return 0;
  return lead.accel_mps2 < 0
             ? lead.speed_mps * lead.speed_mps / (-2 * lead.accel_mps2)
             : never;
}

double speed_constraints::follower::at(double t_s) const {
  const auto v = lead.speed_mps, b = std::max(0.0, -lead.accel_mps2);
  const auto t = b > 0 ? std::min(t_s, v / b) : t_s;
  return touch_m + t * (v - b * t / 2);
}

double speed_constraints::follower::when_s(double way_m) const {
  const auto way = way_m - touch_m;
  const auto v = lead.speed_mps, b = std::max(0.0, -lead.accel_mps2);
  if (b == 0)
    return v > 0 ? way / v : (way > 0 ? never : -never);
  const auto rest = v * v - 2 * b * way;
  return rest < 0 ? never : (v - std::sqrt(rest)) / b;
}

std::optional<double> speed_constraints::promised_s(double way_m) const {
  assert(std::isfinite(way_m));
  const auto next =
      std::ranges::lower_bound(promised, way_m, {}, &appointment::at_m);
  if (next == promised.end()
      || (next == promised.begin() && next->at_m > way_m))
    return std::nullopt;
  if (next == promised.begin())
    return next->time_s;
  const auto& last = *std::prev(next);
  assert(last.at_m < way_m && way_m <= next->at_m);
  return std::lerp(last.time_s, next->time_s,
                   (way_m - last.at_m) / (next->at_m - last.at_m));
}

} // namespace sofof::planners
