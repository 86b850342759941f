// Drives that are agreed on or told, as bounds of the own speeds.
#include "planners/trajectory/told_bounds.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double kept_to_s = 0.25;
constexpr double told_gap_s = 0.6, told_gap_m = 2.5;
/// Behind where it comes to rest: room to stop calmly.
constexpr double standing_gap_m = 1.5;

/// Who cannot keep to it comes later by so much at most, if it can. Without a
/// bound a plan may wait for seconds at a place, which costs it nothing.
constexpr double bounded_late_s = 1.0;

/// Places that are nearer to the car, or to each other, say nothing new.
constexpr double next_bound_m = 0.3, places_apart_m = 0.2;
constexpr double told_apart_m = 1.0;

/// Where a car waits it may stop with its axle so much farther on.
constexpr double rests_within_m = 0.6;
/// Deceleration of a car that cannot stop before its waiting place any more.
constexpr double rests_mps2 = 1;

} // namespace

void told_bounds::keep_to(const agreed_drive& agreed, double age_s,
                          const way_from_car& way, speed_constraints& task) {
  assert(std::isfinite(age_s) && task.speed_mps >= 0);
  assert(std::ranges::is_sorted(agreed.axle, {}, &way_moment::s_m));
  promised_.clear();
  for (const auto& x : agreed.axle) {
    const auto way_m = way(x.s_m);
    if (way_m > next_bound_m
        && (promised_.empty()
            || way_m > promised_.back().at_m + places_apart_m))
      promised_.push_back({way_m, x.t_s - age_s});
  }
  assert(std::ranges::is_sorted(promised_, {},
                                &speed_constraints::appointment::at_m));
  task.promised = promised_;
  task.promised_from_m = way(agreed.binds_from_m);
  task.sooner_s = task.later_s = kept_to_s;
  if (agreed.waits_at_m) {
    const auto stops_m = task.speed_mps * task.speed_mps / (2 * rests_mps2);
    task.stop_m =
        std::min(task.stop_m,
                 std::max(stops_m, way(*agreed.waits_at_m) + rests_within_m));
  }
}

void told_bounds::follow(std::span<const way_moment> told, double age_s,
                         double front_m, const way_from_car& way,
                         speed_constraints& task) {
  assert(std::isfinite(age_s) && front_m >= 0);
  if (told.empty())
    return;
  windows_.clear();
  for (const auto& x : told) {
    const auto is_last = &x == &told.back(); // it may stand there
    const auto way_m =
        way(x.s_m - front_m) - (is_last ? standing_gap_m : told_gap_m);
    if (way_m > 0
        && (windows_.empty() || is_last
            || way_m > windows_.back().at_m + told_apart_m))
      windows_.push_back(
          {way_m, x.t_s - age_s + told_gap_s, speed_constraints::never});
  }
  assert(windows_.size() <= told.size());
  if (windows_.empty())
    return; // too close to go by what it tells
  windows_.insert(windows_.end(), task.windows.begin(), task.windows.end());
  task.windows = windows_;
  task.ahead.reset();
}

speed_planner::result in_time_or_late(speed_planner& planner,
                                      const planned_path& path, double way_m,
                                      speed_constraints& task,
                                      const ocp::budget& go_on) {
  assert(std::isfinite(way_m));
  auto result = planner.plan(path, way_m, task, go_on);
  if (task.promised.empty())
    return result;
  for (const auto later_s : {bounded_late_s, speed_constraints::never})
    if (planner.motion().empty()) {
      task.later_s = later_s;
      result = planner.plan(path, way_m, task, go_on);
    }
  return result;
}

} // namespace sofof::planners
