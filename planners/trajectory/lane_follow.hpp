// A planner that keeps the lane, the limits, and its distance.
#pragma once

#include "planners/scene/lane_motion.hpp"
#include "planners/speed/braking.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "planners/speed/route_profile.hpp"
#include "planners/trajectory/trajectory_planner.hpp"

namespace sofof::planners {

/// Jerk-limited speed profile with car following and stop lines, and a
/// lateral offset that decays to the centre line. The end of an open route
/// is a stop line. A plan made from a point of the plan before continues it.
class lane_follow final : public trajectory_planner {
public:
  /// @param way  Made with the same style.
  lane_follow(route_profile_ptr way, comfort_limits params);

  /// The same, with a profile of its own.
  lane_follow(world::route_ptr way, const comfort_limits& params);

  plan_report plan(time_point now, const planning_input& input,
                   const world::trajectory* previous, world::trajectory& out,
                   const ocp::budget& go_on = {}) override;

private:
  struct traffic_ahead;
  double wanted_accel(const lane_motion& x, const traffic_ahead& others) const;
  double jerk_limit(double accel_mps2) const;
  double next_accel(const lane_motion& x, const traffic_ahead& others) const;

  route_profile_ptr way_;
  comfort_limits params_;
  braking_style style_;
};

} // namespace sofof::planners
