// Going through plans point by point.
#include "world/vehicle/plan_comfort.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {

void motion_extremes::add(const motion_extremes& x) {
  lateral_accel_mps2 = std::max(lateral_accel_mps2, x.lateral_accel_mps2);
  jerk_mps3 = std::max(jerk_mps3, x.jerk_mps3);
  min_accel_mps2 = std::min(min_accel_mps2, x.min_accel_mps2);
}

void plan_figures::add(const plan_figures& x) {
  count += x.count;
  emergency += x.emergency;
  kept += x.kept;
  stops += x.stops;
  imperfect += x.imperfect;
  safe_stops += x.safe_stops;
  extremes.add(x.extremes);
}

double felt_jerk(double before_mps, double after_mps, double change_mps2,
                 double dt_s) {
  if (before_mps < coming_to_rest_mps && after_mps <= before_mps)
    return 0;
  return std::abs(change_mps2) / dt_s;
}

motion_extremes extremes_of(const trajectory& plan) {
  assert(plan.points.size() >= 2);
  motion_extremes most;
  const auto step_s = plan.points[1].t_s;
  const auto* before = &plan.points.front();
  for (const auto& p : plan.points) {
    const auto jerk = felt_jerk(before->speed_mps, p.speed_mps,
                                p.accel_mps2 - before->accel_mps2, step_s);
    most.add({p.speed_mps * p.speed_mps * std::abs(p.curvature_1pm), jerk,
              p.accel_mps2});
    before = &p;
  }
  return most;
}

plan_jump jump_between(const trajectory& old, const trajectory& next,
                       time_point t) {
  assert(!old.empty() && !next.empty());
  const auto from = old.at(t);
  const auto to = next.at(t);
  const point tangent{std::cos(from.heading_rad), std::sin(from.heading_rad)};
  return {std::abs(cross(tangent, to.at - from.at)),
          std::abs(to.curvature_1pm - from.curvature_1pm),
          std::abs(to.speed_mps - from.speed_mps),
          std::abs(to.accel_mps2 - from.accel_mps2)};
}

} // namespace sofof::world
