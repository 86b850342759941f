// What a trajectory planner starts from: own motion and the others.
#pragma once

#include "base/time.hpp"
#include "planners/scene/driving_scene.hpp"
#include "world/roads/route.hpp"

namespace sofof::planners {

/// The state from which to plan, in the frame of the route. It is the point
/// of the plan in use where that plan is followed well (so that plans join
/// without a jolt), else the measured state.
struct planning_input {
  time_point at;                ///< When this held.
  double s_m = 0;               ///< Rear axle on the route, laps included.
  double d_m = 0;               ///< Offset from the centre line, left positive.
  double heading_error_rad = 0; ///< Against the centre line's tangent.
  double curvature_1pm = 0;     ///< Of the way it drives, left positive.
  double speed_mps = 0;
  double accel_mps2 = 0;
  driving_scene others;
};

/// What is known of the others is left out: it stays in the vehicle.
void visit_fields(auto& v, planning_input& x) {
  v("at", x.at);
  v("s_m", x.s_m);
  v("d_m", x.d_m);
  v("heading_error_rad", x.heading_error_rad);
  v("curvature_1pm", x.curvature_1pm);
  v("speed_mps", x.speed_mps);
  v("accel_mps2", x.accel_mps2);
}

/// @returns `x` with what no car's own motion can be cut off (10 000 km, 5 m
/// off the lane, 1 rad, 1/m, 0 to 100 m/s, 20 m/s²); what is no number is 0.
planning_input made_possible(planning_input x);

} // namespace sofof::planners
