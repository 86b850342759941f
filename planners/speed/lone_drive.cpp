// How long a way takes a car that is alone on it.
#include "planners/speed/lone_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double least_step_m = 0.01;
constexpr double rests_below_mps = 0.1;

/// @returns what it costs that an acceleration builds up from rest, or fades
/// out into it: every speed is reached so much later, or left so much sooner.
double built_up_s(double accel_mps2, double jerk_mps3) {
  return accel_mps2 / jerk_mps3 / 2;
}

} // namespace

double lone_drive_s(const route_profile& road, const comfort_limits& style,
                    double from_m, double speed_mps, double to_m) {
  assert(speed_mps >= 0 && to_m >= from_m && std::isfinite(to_m));
  constexpr double step_m = 1;
  const auto& way = road.line.way();
  const auto end_m = way.length_m() - style.front_m;
  const auto accel = style.max_accel_mps2, decel = style.comfort_decel_mps2;
  const auto most = [&](double s_m) { // v²/2
    const auto limit = road.envelope.limit_mps(s_m);
    const auto free = limit * limit / 2;
    return way.closed() ? free
                        : std::min(free, decel * std::max(end_m - s_m, 0.0));
  };
  auto takes_s =
      speed_mps < rests_below_mps ? built_up_s(accel, style.max_jerk_mps3) : 0.0;
  auto w = std::min(speed_mps * speed_mps / 2, most(from_m));
  for (auto s = from_m; s < to_m;) {
    const auto way_m = std::min(step_m, to_m - s);
    const auto next = std::min(w + accel * way_m, most(s + way_m));
    const auto mean_mps = (std::sqrt(2 * w) + std::sqrt(2 * next)) / 2;
    takes_s += way_m / std::max(mean_mps, rests_below_mps);
    w = next;
    s += std::max(way_m, least_step_m);
  }
  if (!way.closed() && to_m >= end_m - step_m)
    takes_s += built_up_s(decel, style.max_jerk_mps3);
  return takes_s;
}

} // namespace sofof::planners
