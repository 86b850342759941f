// How far the clock of a host is off.
#pragma once

#include "base/time.hpp"

namespace sofof::actors {

/// The difference between the clock of a host and the one that its machine has:
/// for tests of runs on several hosts, whose clocks never quite agree. None by
/// default.
struct clock_error {
  duration shift{};
  double drift = 0; ///< Seconds a second, since `from`; > -1.
  time_point from;

  /// @returns what the host's clock shows when the machine's shows `t`.
  time_point shown(time_point t) const {
    return drift == 0 ? t + shift
                      : t + shift + from_seconds(drift * to_seconds(t - from));
  }

  /// @returns what the machine's clock shows when the host's shows `t`.
  time_point meant(time_point t) const {
    return drift == 0 ? t - shift
                      : t - shift
                            - from_seconds(drift / (1 + drift)
                                           * to_seconds(t - shift - from));
  }
};

} // namespace sofof::actors
