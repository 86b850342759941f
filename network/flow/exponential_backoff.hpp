// When to try again what has failed.
#pragma once

#include "base/time.hpp"

namespace sofof::network {

/// Waits between attempts at one thing: none before the first, then periods
/// that double from 100 ms to 1 s, each shortened at random by up to half of
/// it, so that many who lost the same peer do not come back as one.
class exponential_backoff {
public:
  /// @param draw  Uniform in [0, 1).
  /// @returns how long to wait before the next attempt, ≤ 1 s.
  duration next_wait(double draw);

  /// The next attempt starts at once again. To be called when the peer has
  /// proved itself: one that accepts and hangs up would be tried without end.
  void succeeded() { period_ = duration{0}; }

private:
  duration period_{0};
};

} // namespace sofof::network
