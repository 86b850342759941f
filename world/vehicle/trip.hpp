// How long a drive takes, and what it would take a car that is alone.
#pragma once

#include "world/roads/route.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sofof::world {

/// What held a car up on its way.
struct trip_figures {
  double driven_s = 0;        ///< Since it appeared.
  double alone_s = 0;         ///< It would have taken, see `drive_alone`.
  std::uint64_t stops = 0;    ///< How often it came to rest.
  double longest_stop_s = 0;
  bool has_arrived = false;   ///< At the end of an open route.

  double delay_s() const { return std::max(0.0, driven_s - alone_s); }
};

/// The drive of a car alone: as fast as limits and bends (2.2 m/s² sideways)
/// allow, speeding up by 1.5 and braking by 2 m/s².
class drive_alone {
public:
  /// @param from_m     Where it begins, rear axle on the route.
  /// @param speed_mps  >= 0.
  drive_alone(const route& way, double from_m, double speed_mps);

  /// @returns how long it takes from the beginning to there, s.
  /// @param to_m  On the route, laps included; before the beginning: 0.
  double time_s(double to_m) const;

private:
  static constexpr double step_m = 1;
  double from_m_;
  double lap_s_ = 0, lap_m_ = 0;  // of a closed route, once it is at speed
  std::vector<double> times_s_;   // every step from the beginning
};

/// Looks at a car after each of its steps.
class trip_meter {
public:
  /// @param x  Its speed now, m/s.
  void add(double speed_mps, double step_s);

  std::uint64_t stops() const { return stops_; }
  double longest_stop_s() const { return longest_s_; }

private:
  bool has_moved_ = false, stands_ = false;
  std::uint64_t stops_ = 0;
  double stood_s_ = 0, longest_s_ = 0;
};

} // namespace sofof::world
