// A plan that brakes on the line of another one.
#include "planners/safety/proper_response.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace sofof::planners {

namespace {

/// @returns the plan's point at an arc length that it passes between two times.
world::trajectory_point passing(const world::trajectory& plan, double s_m,
                                double low_s, double high_s) {
  assert(low_s <= high_s);
  constexpr auto close_m = 1e-4;
  constexpr auto most_halves = 40;
  auto point = plan.at(high_s);
  for (int k = 0; k < most_halves && point.s_m - s_m > close_m; ++k) {
    const auto middle_s = (low_s + high_s) / 2;
    const auto middle = plan.at(middle_s);
    if (middle.s_m < s_m) {
      low_s = middle_s;
    } else {
      high_s = middle_s;
      point = middle;
    }
  }
  assert(point.s_m >= s_m - close_m);
  return point;
}

} // namespace

void respond_properly(world::trajectory& plan, double decel_mps2) {
  assert(plan.is_sound());
  assert(decel_mps2 > 0);
  const auto planned = std::exchange(plan.points, {});
  const world::trajectory along{plan.start, planned};
  const auto step_s = planned[1].t_s;
  auto s_m = planned.front().s_m, v = planned.front().speed_mps;
  auto passed_s = 0.0; // when the plan is where the point before is
  for (std::size_t k = 0; k < planned.size(); ++k) {
    const auto& then = planned[k];
    const auto& next = planned[std::min(k + 1, planned.size() - 1)];
    auto point = passing(along, s_m, passed_s, then.t_s);
    passed_s = point.t_s;
    point.t_s = then.t_s;
    point.s_m = s_m;
    point.speed_mps = v;
    point.accel_mps2 =
        v > 0 ? std::min({-decel_mps2, then.accel_mps2, next.accel_mps2}) : 0;
    plan.points.push_back(point);
    const auto slower = std::max(0.0, v + point.accel_mps2 * step_s);
    s_m += slower > 0 ? step_s * (v + slower) / 2
           : v > 0    ? v * v / (-2 * point.accel_mps2)
                      : 0;
    v = slower;
  }
  assert(plan.points.size() == planned.size());
}

} // namespace sofof::planners
