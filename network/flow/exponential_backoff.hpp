// When to try again what has failed.
#pragma once

#include "base/time.hpp"

namespace sofof::network {

/// Waits between attempts at one thing: none before the first, then periods
/// that double from a first to a longest one, each shortened at random by up to
/// half of it, so that many who lost the same peer do not come back as one.
class exponential_backoff {
public:
  explicit exponential_backoff(duration first = std::chrono::milliseconds{100},
                               duration longest = std::chrono::seconds{1})
      : first_{first}, longest_{longest} {}

  /// @param draw  Uniform in [0, 1).
  /// @returns how long to wait before the next attempt, ≤ the longest period.
  duration next_wait(double draw);

  /// The next attempt starts at once again. To be called when the peer has
  /// proved itself: one that accepts and hangs up would be tried without end.
  void succeeded() { period_ = duration{0}; }

private:
  duration first_, longest_;
  duration period_{0};
};

} // namespace sofof::network
