// The longest response time under which all that a vehicle sees is safe.
#pragma once

#include "planners/safety/rss.hpp"
#include "world/roads/route.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace sofof::planners {

/// A vehicle on its way, and what it knows of others.
struct safety_scene {
  const world::route& way;
  double s_m = 0;        ///< Its rear axle on the way, laps included.
  double d_m = 0;        ///< Likewise, left of the lane's middle.
  double turned_rad = 0; ///< Its heading against the lane.
  double speed_mps = 0;  ///< ≥ 0.
  std::span<const world::perceived_object> objects{};
  /// Where its front has to stop on the way; nullopt: nowhere.
  std::optional<double> stop_at_m{};
  /// At crossings before that place; else whoever comes from the side has it,
  /// unless it can stop.
  bool has_priority = false;
};

/// How long the response may take, and for whose sake not longer.
struct safe_response {
  double longest_s = 0; ///< In [0, most]; 0: the scene is not safe under any.
  /// "free", "follow", "oncoming", "crossing" or "line".
  std::string_view because = "free";
};

/// Each body counts for itself, by where it is seen from the way:
/// * who drives along the way, or against it, is safe if the distance along
///   *or* across is (definitions 1, 2, 6);
/// * who comes from the side, and could not stop before the own lane, is safe
///   if the own vehicle has priority or can stop before it (definitions 16 to
///   18). A grant is priority given, as is a drive through a crossing that was
///   agreed and binds; a line before one that is not granted is a place to stop
///   at;
/// * who is across the own lane is a place to stop at, whoever has priority;
/// * who is behind has to keep its distance itself.
///
/// @param car     The own vehicle's body.
/// @param most_s  s, > 0; longer is of no interest.
/// @returns the longest response time under which all of them are safe.
safe_response longest_safe_response(const safety_scene& x,
                                    const rss_assumptions& assumed,
                                    const world::vehicle_params& car,
                                    double most_s);

} // namespace sofof::planners
