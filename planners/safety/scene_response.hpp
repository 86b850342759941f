// The longest response time under which a scene is safe that was told.
#pragma once

#include "planners/safety/safe_response.hpp"
#include "planners/scene/driving_scene.hpp"

namespace sofof::planners {

/// Where a vehicle is on its way, in the arc lengths of a scene.
struct scene_viewer {
  double s_m = 0;           ///< Its rear axle, laps included.
  double d_m = 0;           ///< Likewise, left of the lane's middle.
  double turned_rad = 0;    ///< Its heading against the lane.
  double speed_mps = 0;     ///< ≥ 0.
  double curvature_1pm = 0; ///< Of the way, there.
  /// At crossings; else whoever goes first there and cannot stop has it.
  bool has_priority = false;
};

/// As `longest_safe_response` for what is on the way, whoever found it:
/// * the lead is followed (definition 1);
/// * a body beside the way is safe if the distance along *or* across is
///   (definitions 1, 2, 6);
/// * a stretch ahead on which somebody is, or to which somebody comes first
///   who could not stop before it any more, is a place to stop at (definitions
///   16 to 18).
///
/// @param most_s  s, > 0; longer is of no interest.
/// @returns the longest response time under which all of them are safe.
safe_response longest_safe_response(const driving_scene& told,
                                    const scene_viewer& me,
                                    const rss_assumptions& assumed,
                                    const world::vehicle_params& car,
                                    double most_s);

} // namespace sofof::planners
