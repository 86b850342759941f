// Where a new plan begins.
#include "planners/trajectory/trajectory_planner.hpp"

#include "planners/scene/lane_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

// A plan that is not driven, as that of a provider that stands by, may depart
// from the vehicle by so much; `plan_limits::same_place_m` is more.
constexpr double same_drive_m = 0.5;
constexpr double same_speed_mps = 1.0;
constexpr double max_lead_age_s = 0.5;

/// @returns the own motion, without the others: they would take memory.
planning_input own(const planning_input& x) {
  planning_input alone;
  alone.at = x.at;
  alone.s_m = x.s_m;
  alone.d_m = x.d_m;
  alone.heading_error_rad = x.heading_error_rad;
  alone.curvature_1pm = x.curvature_1pm;
  alone.speed_mps = x.speed_mps;
  alone.accel_mps2 = x.accel_mps2;
  return alone;
}

// What solvers may be off by.
constexpr double lateral_slack_mps2 = 0.1, jerk_slack_mps3 = 0.5;

} // namespace

void tell_extremes(const world::trajectory& plan, const comfort_limits& style,
                   plan_report& report) {
  assert(plan.is_sound() && style.max_lateral_accel_mps2 > 0);
  const auto most = world::extremes_of(plan);
  report.extremes = most;
  report.emergency |= most.lateral_accel_mps2
                          > style.max_lateral_accel_mps2 + lateral_slack_mps2
                      || most.jerk_mps3 > style.max_jerk_mps3 + jerk_slack_mps3;
  assert(std::isfinite(most.jerk_mps3));
}

planning_input joined(const world::route& way, time_point now,
                      const planning_input& input,
                      const world::trajectory* previous) {
  if (previous && !previous->empty() && previous->start <= now
      && now <= previous->end()) {
    assert(previous->points.front().t_s == 0);
    const auto seen = moved_forward(own(input), previous->start);
    const auto then = previous->at(std::max(input.at, previous->start));
    assert(std::isfinite(then.s_m) && then.speed_mps >= 0);
    if (std::abs(then.s_m - seen.s_m) <= same_drive_m
        && std::abs(then.speed_mps - seen.speed_mps) <= same_speed_mps) {
      auto on_it = seen_from(way, previous->at(now));
      on_it.at = now;
      return on_it;
    }
  }
  return made_possible(moved_forward(made_possible(own(input)), now));
}

lead_vehicle moved_forward(lead_vehicle lead, time_point seen, time_point now) {
  const auto age_s = std::clamp(to_seconds(now - seen), 0.0, max_lead_age_s);
  const auto accel = std::min(lead.accel_mps2, 0.0);
  const auto then =
      advance({lead.rear_s_m, lead.speed_mps, accel}, accel, age_s);
  lead.rear_s_m = then.s_m;
  lead.speed_mps = then.speed_mps;
  lead.accel_mps2 = then.accel_mps2;
  return lead;
}

} // namespace sofof::planners
