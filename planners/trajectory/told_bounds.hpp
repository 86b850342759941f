// What was agreed on at a crossing, and what a car ahead tells of its drive, as
// bounds of the own speeds.
#pragma once

#include "planners/scene/driving_scene.hpp"
#include "planners/speed/speed_planner.hpp"

#include <functional>
#include <span>
#include <vector>

namespace sofof::planners {

/// Owns what the constraints that it fills in refer to.
class told_bounds {
public:
  /// @returns the way of the rear axle from the car to an arc length on its
  ///          route, m; negative behind it.
  using way_from_car = std::function<double(double s_m)>;

  /// Keeps the car to a drive within 0.25 s, and to the place where that waits.
  /// @param age_s  Since the drive's times begin.
  void keep_to(const agreed_drive& agreed, double age_s,
               const way_from_car& way, speed_constraints& task);

  /// Keeps the car 0.6 s and 2.5 m behind the rear of who leads, at the times
  /// that this one tells, instead of behind a car at constant speed; 1.5 m at
  /// the last of its places, where it may stand.
  /// @param told     Rising; empty, or all too close: nothing is changed.
  /// @param age_s    Since its times begin.
  /// @param front_m  Rear axle to front bumper of the own car.
  void follow(std::span<const way_moment> told, double age_s, double front_m,
              const way_from_car& way, speed_constraints& task);

private:
  std::vector<speed_constraints::appointment> promised_;
  std::vector<speed_constraints::window> windows_;
};

/// Plans within the drive that was promised or, where that is not possible any
/// more, up to a second later, or else whenever: then `later_s` of the task is
/// infinite.
speed_planner::result in_time_or_late(speed_planner& planner,
                                      const planned_path& path, double way_m,
                                      speed_constraints& task,
                                      const ocp::budget& go_on);

} // namespace sofof::planners
