// Several providers plan the same cycles: the first response wins.
#pragma once

#include "base/time.hpp"

#include <cstdint>
#include <optional>

namespace sofof::offloading {

/// Takes of each cycle the first response only, and none of a cycle before one
/// that has been answered: the vehicle is past it. With a hedge the second
/// provider is asked only when the first has not answered for a while.
/// Providers need no common grid: they are half a period out of step at most,
/// so what began later than that after a cycle belongs to the next one. Whether
/// two providers' plans may follow each other, `continues` tells. O(1) in time
/// and memory. Source: Dean & Barroso 2013 (hedged requests).
class first_response {
public:
  /// @param period  Of the cycles, >= 0.
  explicit first_response(duration period = {}) : period_{period} {}

  /// @param began  When the cycle began that was answered. One that was asked
  ///               for: a made-up one would shut out all before it.
  /// @returns whether to use the response; others are counted as dropped.
  bool use(time_point began);

  /// @returns whether the cycle that began then has been answered, or one after
  /// it.
  bool answered(time_point began) const {
    return newest_ && began < *newest_ + period_ / 2;
  }

  /// @param began        When the first provider began the cycle.
  /// @param hedge_after  A good choice is the latency that 70 to 80 % of
  ///                     responses stay below.
  /// @returns whether it is time to ask the second.
  bool hedge_due(time_point began, time_point now, duration hedge_after) const {
    return !answered(began) && now - began >= hedge_after;
  }

  std::uint64_t dropped() const { return dropped_; }

private:
  duration period_;
  std::optional<time_point> newest_; // answered: when it began
  std::uint64_t dropped_ = 0;
};

} // namespace sofof::offloading
