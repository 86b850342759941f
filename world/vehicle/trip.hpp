// What a trip was like: how long it took, and how often the car stood.
#pragma once

#include <cstdint>

namespace sofof::world {

/// Of a car, from where it appears.
struct trip_figures {
  double driven_s = 0;       ///< Until it arrived, or up to now.
  double alone_s = 0;        ///< What the same way takes a car alone.
  std::uint64_t stops = 0;   ///< How often it came to rest, having moved.
  double longest_stop_s = 0; ///< Of these.
  bool has_arrived = false;  ///< At the end of an open route.

  /// @returns what others cost it; below 0 where it was quicker than reckoned.
  double delay_s() const { return driven_s - alone_s; }
};

/// Looks at a car after each of its steps.
class stop_meter {
public:
  /// @param speed_mps  Of the car now, >= 0.
  /// @param step_s     Since the last call.
  void add(double speed_mps, double step_s);

  std::uint64_t count() const { return count_; }
  double longest_s() const { return longest_s_; }

private:
  bool has_moved_ = false; // since it stood last
  std::uint64_t count_ = 0;
  double stood_s_ = 0, longest_s_ = 0;
};

} // namespace sofof::world
