// Moving along a lane: steps in time, the way back to the centre line, and
// where on the map that is.
#pragma once

#include "planners/scene/planning_input.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/trajectory.hpp"

namespace sofof::planners {

/// Motion along the centre line.
struct lane_motion {
  double s_m = 0;
  double speed_mps = 0;
  double accel_mps2 = 0;
};

/// One step at constant jerk; a car that brakes to rest within it stays
/// there.
/// @param accel_mps2  At the end of the step.
lane_motion advance(const lane_motion& x, double accel_mps2, double dt_s);

/// @returns `x` at a later (or the same) moment: straight ahead at constant
/// acceleration, to rest at most. What it knows of others stays as it was.
planning_input moved_forward(planning_input x, time_point now);

/// @returns the motion and offset at a point of a plan as seen from the route.
planning_input seen_from(const world::route& way,
                         const world::trajectory_point& p);

/// A car's return to the centre line of its lane: the offset decays
/// critically damped over the way, so that a plan made on the way continues
/// the plan made before.
class centring {
public:
  /// @param x         Where the car is, how fast, and how it stands.
  /// @param length_m  Way over which the offset decays, > 0; longer at speed.
  centring(const world::route& way, const planning_input& x, double length_m);

  /// @returns the motion along the centre line at the beginning.
  const lane_motion& motion() const { return motion_; }

  /// @returns the point of a plan after `t_s` where the car, as it returns,
  /// has come to `x`.
  world::trajectory_point place(const lane_motion& x, double t_s) const;

private:
  const world::route& way_;
  lane_motion motion_;
  double rate_1pm_ = 0;
  double offset_m_ = 0;
  double slope_ = 0;
};

} // namespace sofof::planners
