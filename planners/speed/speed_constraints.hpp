// What a speed plan has to keep to, along the way that the car is going.
#pragma once

#include "planners/scene/lane_motion.hpp"
#include "planners/speed/braking.hpp"

#include <limits>
#include <optional>
#include <span>

namespace sofof::planners {

/// Ways are those of the rear axle from the car on, m; times are seconds from
/// now on.
struct speed_constraints {
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// A car ahead, at constant speed or at its braking until it stands.
  struct follower {
    double touch_m = 0; ///< Where the bumpers would touch now.
    leader lead;

    /// @returns how far `touch_m` moves until it stands; infinite if never.
    double way_left_m() const;
    /// @returns where it is after `t_s`.
    double at(double t_s) const;
    /// @returns when it comes to `way_m`, or came there, had it always driven
    /// like this; infinite if never, -infinite if it stands behind.
    double when_s(double way_m) const;
  };
  /// Not to be at a place before, or after, some time.
  struct window {
    double at_m = 0;
    double earliest_s = -never;
    double latest_s = never;
  };

  /// When to be at some place.
  struct appointment {
    double at_m = 0, time_s = 0;
  };

  /// @returns when to be there, as was promised; nullopt: whenever.
  std::optional<double> promised_s(double way_m) const;

  double speed_mps = 0;
  double accel_mps2 = 0;
  double stop_m = never; ///< Must not be passed: a line, the route's end.
  std::optional<follower> ahead;
  std::span<const window> windows;
  /// A drive that others rely on, rising; between them in proportion.
  std::span<const appointment> promised;
  double sooner_s = 0, later_s = 0; ///< Than promised, at most, ...
  double promised_from_m = 0;       ///< ... from there on; before, if it can.
  /// Slower than this up to there: it may have to stop for somebody unseen.
  double caution_mps = never, caution_to_m = 0;
};

} // namespace sofof::planners
