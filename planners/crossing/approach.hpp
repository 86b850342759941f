// A vehicle at a crossing, with what is computed of it.
#pragma once

#include "base/ids.hpp"
#include "planners/crossing/crossing_ways.hpp"
#include "planners/crossing/way_motion.hpp"
#include "world/vehicle/trajectory.hpp"

#include <optional>

namespace sofof::planners {

/// A vehicle on its way, as it is known at the crossing.
struct approaching_car {
  station_id who = 0;
  route_profile_ptr way; ///< Not null.
  double s_m = 0;        ///< Rear axle on its route, laps included.
  double speed_mps = 0, accel_mps2 = 0;
  bool is_served = true; ///< It can be told how to drive.
  /// How it was told to, or has claimed to.
  std::optional<world::trajectory> drive;
  bool has_claimed = false; ///< So that does not change any more.
};

/// The same on its way through the crossing. Places are those of its middle,
/// times seconds from now on.
struct approach {
  const approaching_car* is = nullptr;
  crossing_ways::place at;
  way_motion alone; ///< If nobody else were there.
  way_motion told;  ///< As it was told so far, or claims; empty: not at all.
  bool is_fixed = false;   ///< It drives so, whatever the others do.
  double wish_s = 0;       ///< At the line, as at first sight, if alone.
  double line_s = 0;       ///< At the line, as the search has it.
  way_motion motion;       ///< Fixed or planned; empty: none so far.
  bool is_as_told = false; ///< So is that.
};

} // namespace sofof::planners
