// What a body takes of a way.
#pragma once

#include "planners/scene/track.hpp"
#include "world/roads/route.hpp"

#include <optional>

namespace sofof::planners {

/// The part of a way along which a body lies, and how far to the left and right
/// of the way's line it reaches.
struct body_footprint {
  double from_m, to_m;  ///< Arc length.
  double low_m, high_m; ///< Left positive.
  double cosine;        ///< Of the angle to the way.
  double speed_mps;     ///< Along the way.
  double half_lane_m;   ///< There.
};

/// Where on a way a body is looked for.
struct where_to_look {
  double guess_m;    ///< Arc length, ...
  double within_m;   ///< ... to within this.
  double corridor_m; ///< To the left and right of the line, a car's room.
};

/// @returns what a body takes of a way; nullopt if it stays out of the lane and
/// of a car's corridor.
std::optional<body_footprint> measure_body(const world::route& way,
                                           const track& x,
                                           const where_to_look& where);

} // namespace sofof::planners
