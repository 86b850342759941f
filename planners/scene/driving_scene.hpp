// What the others mean on the own way: the world as a planner needs it.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sofof::planners {

/// The nearest road user ahead on one's own way.
struct lead_vehicle {
  std::optional<station_id> station{}; ///< If it sends CAMs.
  double rear_s_m = 0; ///< Its rear bumper, arc length on the follower's
                       ///< route, laps counted as the follower counts.
  double speed_mps = 0;
  double accel_mps2 = 0;
};

/// A stretch of the own way that another road user is going to cross, and
/// when. Times are seconds after `driving_scene::at`.
struct crossing_user {
  double from_m = 0, to_m = 0; ///< Arc length on the own route.
  double enter_s = 0;          ///< Its front comes onto the stretch; 0: it is
                               ///< there.
  double leave_s = 0;          ///< Its rear has left; infinite: it stands.
  bool goes_first = true;      ///< By right of way; else it gives way.
  /// It has to brake so hard, from a second on, to stay off the stretch.
  double brakes_mps2 = std::numeric_limits<double>::infinity();
  std::uint32_t body = 0; ///< One number for all entries of a road user.
};

/// A part of the own way, arc length on the own route.
struct way_stretch {
  double from_m = 0, to_m = 0;
};

/// When to be, or somebody is, at a place of the own way.
struct way_moment {
  double s_m = 0; ///< Arc length on the own route.
  double t_s = 0; ///< After `driving_scene::at`.
};

/// How the own car goes through a crossing, as was agreed with the others.
struct agreed_drive {
  std::vector<way_moment> axle;     ///< Of its rear axle; both rising.
  double binds_from_m = 0;          ///< It has to keep to it from there on.
  std::optional<double> waits_at_m; ///< Its rear axle does, before that.
};

/// A body that reaches into the lane but leaves room to pass beside it.
struct lane_obstacle {
  double from_m = 0, to_m = 0;  ///< Of the body, arc length on the own route.
  double low_m = 0, high_m = 0; ///< Its lateral extent, left positive, with
                                ///< what is uncertain of it.
  double speed_mps = 0; ///< Along the own route; negative when it comes.
  double lacks_m = 0;   ///< So much room is lacking; it is passed all the same,
                        ///< as that has begun, or cannot be stopped any more.
  double left_m = 0; ///< So much room there is besides, left of the lane: its
                     ///< opposite is free for long enough.
};

/// What a driver has to know about the others.
struct driving_scene {
  time_point at;
  /// The own car has stood for so long that it waits for nobody who stands any
  /// more, goes on as far as it can, and goes before who can let it go without
  /// effort: everybody else may think the same.
  bool is_impatient = false;
  std::optional<lead_vehicle> lead;
  std::vector<way_moment> lead_told; ///< Where its rear will be, as it tells;
                                     ///< rising; empty: it does not.
  std::optional<agreed_drive> agreed;
  /// The front bumper must not pass this arc length on the own route: a
  /// crossing has not been granted yet.
  std::optional<double> stop_at_m;
  std::vector<crossing_user> crossings; ///< In order of `from_m`.
  std::vector<lane_obstacle> beside;    ///< In order of `from_m`.
  /// Where crossings begin at which others would go first, whether anybody is
  /// seen or not: arc length on the own route, rising.
  std::vector<double> yields_m;
  /// Where others cross: no place to come to rest. Rising, and apart by more
  /// than a car's length, but for where the own front is: one stretch that it
  /// has begun, and what follows it.
  std::vector<way_stretch> keep_free;
};

} // namespace sofof::planners
