// A planner that keeps the lane, the limits, and its distance.
#pragma once

#include "planners/braking.hpp"
#include "planners/lane_motion.hpp"
#include "planners/planning_input.hpp"
#include "planners/speed_envelope.hpp"
#include "world/settings.hpp"
#include "world/trajectory.hpp"
#include "world/vehicle.hpp"

namespace sofof {

/// What a comfortable and safe drive is.
struct lane_follow_params {
  double horizon_s = 6.0;
  double step_s = 0.1;
  double max_accel_mps2 = 1.5;
  double comfort_decel_mps2 = 2.0;
  double max_decel_mps2 = 6.0; ///< Emergency.
  double max_jerk_mps3 = 1.5;
  double emergency_jerk_mps3 = 15.0;
  double max_lateral_accel_mps2 = 2.2;
  double time_gap_s = 1.5;
  double standstill_gap_m = 3.0;
  double centring_length_m = 15.0; ///< Offsets decay over this length.
  double front_m = vehicle_params{}.front_m; ///< Of the car; no option.

  void fields(settings& s);
};

/// Jerk-limited speed profile with car following and stop lines, and a
/// lateral offset that decays to the centre line. The end of an open route
/// is a stop line. A plan made from a point of the plan before continues it.
class lane_follow {
public:
  lane_follow(route_ptr way, lane_follow_params params);

  /// Plans from `now` on.
  /// @param input     May be older than `now`: where `previous` covers `now`
  ///                  and agrees with the input within 1 m and 1 m/s, the
  ///                  plan starts at its point for `now`, so that plans join
  ///                  without a jolt; else the input is moved forward at
  ///                  constant acceleration. The lead vehicle is moved forward
  ///                  (by half a second at most) at constant speed, or at its
  ///                  braking until it stands.
  /// @param previous  The plan that this planner gave last; null if none.
  ///                  Not `&out`.
  /// @param out       The plan; its points are reused, so that a control loop
  ///                  needs no heap after the first cycle. `out.start == now`.
  void plan(time_point now, const planning_input& input,
            const trajectory* previous, trajectory& out) const;

private:
  struct surroundings;
  planning_input start_of(time_point now, const planning_input& input,
                          const trajectory* previous) const;
  double wanted_accel(const lane_motion& x, const surroundings& others) const;
  double jerk_limit(double accel_mps2) const;
  double next_accel(const lane_motion& x, const surroundings& others) const;

  route_ptr way_;
  lane_follow_params params_;
  braking_style style_;
  speed_envelope envelope_;
};

} // namespace sofof
