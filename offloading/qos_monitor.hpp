// Judges results against the limits that a service was promised to keep.
// Source: Dehler & Buchholz 2025, QoS check of the service requester.
#pragma once

#include "base/time.hpp"

#include <string>
#include <string_view>

namespace sofof::offloading {

/// @returns whether a result came in time: exactly at the limit is in time,
/// from the future is not.
/// @param since  When it was created, or its input was made.
constexpr bool in_time(time_point since, time_point received,
                       duration longest) {
  return since <= received && received - since <= longest;
}

/// @param name   The limit's: "latency".
/// @param value  What did not keep to it: a time above the limit, or the
///               response time that a scene allows, below that of a split.
/// @returns how an event tells that a limit did not hold:
/// "latency value_ms=61.200000 limit_ms=50.000000".
std::string in_words(std::string_view name, duration value, duration limit);

/// Watches the gaps between received results.
class gap_monitor {
public:
  explicit gap_monitor(duration max_interarrival)
      : max_interarrival_{max_interarrival} {}

  void arrived(time_point t) { last_ = t; }

  /// @returns the first moment at which the gap is too long unless another
  /// result arrives: one nanosecond past the limit, so that a link whose
  /// period is the limit does not trip by the order of simultaneous events.
  time_point deadline() const {
    return last_ + max_interarrival_ + duration{1};
  }

  /// @returns when the latest result came.
  time_point last() const { return last_; }

  bool too_long(time_point now) const { return now >= deadline(); }

private:
  duration max_interarrival_;
  time_point last_;
};

} // namespace sofof::offloading
