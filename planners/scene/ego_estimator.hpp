// Where a vehicle is that is planned for from afar: what it said last, carried
// on to now.
#pragma once

#include "planners/scene/planning_input.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/trajectory.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace sofof::planners {

/// A vehicle's own motion as it told it (a CAM).
struct reported_state {
  time_point at;          ///< When this held.
  point position;         ///< Rear axle, m, east-north.
  double heading_rad = 0; ///< Counter-clockwise from east.
  double speed_mps = 0;
  double accel_mps2 = 0;
  double curvature_1pm = 0; ///< Left positive.
};

/// The motion of one vehicle on its route, from CAMs that are up to some
/// seconds old and from the plans that it was sent.
///
/// * Along the plan: what the vehicle was off its plan when it told, it is off
///   now; accel and curvature are the plan's. Plans that follow each other
///   are one motion, of which every plan gives the part until the next one
///   begins; where the next one does not begin where this one is, it is the
///   estimate that has been planned from, and no way that was driven.
/// * Without a plan for all the time since it told, or if it was not within
///   5 m and 1 m/s of it: at constant acceleration, to rest at most, and
///   as much more or less bent than the route as it was.
///
/// Needs no heap.
class ego_estimator {
public:
  /// @param s_m  About where on the route, within 20 m, the vehicle is when it
  ///             is heard for the first time; laps included.
  ego_estimator(world::route_ptr way, double s_m);

  /// Takes what the vehicle told; if it is older than what is known, or no
  /// numbers, nothing. Who is more than 5 m beside the route is not on it, and
  /// nowhere until it is heard there again.
  void on_report(const reported_state& told);

  /// Takes the plan that the vehicle follows from its start on.
  /// @param plan  Not empty; later than the plan before, else nothing.
  void follow(const world::trajectory& plan);

  /// @returns the motion at `now` (also in `at`), for `joined` to compare
  /// with the plan; nothing while the vehicle was not heard.
  std::optional<planning_input> at(time_point now) const;

private:
  /// Motion on the route; also a difference of two.
  struct motion {
    double s_m = 0, d_m = 0, heading_error_rad = 0, speed_mps = 0;

    motion operator-(const motion& b) const {
      return {s_m - b.s_m, d_m - b.d_m, heading_error_rad - b.heading_error_rad,
              speed_mps - b.speed_mps};
    }
    void operator+=(const motion& b) {
      s_m += b.s_m;
      d_m += b.d_m;
      heading_error_rad += b.heading_error_rad;
      speed_mps += b.speed_mps;
    }
  };
  struct moment {
    time_point at;
    motion where;
  };

  static motion between(const moment& a, const moment& b, time_point t);
  motion on_route(const world::trajectory_point& p) const;
  std::optional<motion> planned(time_point t) const;
  std::optional<motion> off_plan(time_point now) const;
  planning_input along_plan(time_point now, const motion& off) const;
  planning_input alone(time_point now) const;

  const moment& start(std::size_t age) const {
    return starts_[(newest_ + starts_.size() - age) % starts_.size()];
  }

  world::route_ptr way_;
  double first_s_m_;
  std::optional<reported_state> told_;
  motion heard_; // when `told_`
  world::trajectory plan_;
  // Where plans began, as seen from the last one; a ring. Plans come each
  // 50 ms: more than 3 s, when a silent vehicle has been given up.
  std::array<moment, 64> starts_{};
  std::size_t newest_ = 0, known_ = 0;
};

} // namespace sofof::planners
