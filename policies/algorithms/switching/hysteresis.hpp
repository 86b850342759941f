// Keeps a scorer from switching to and fro.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <optional>

namespace sofof::policies {

struct hysteresis_options {
  double margin = 0.05; ///< Normalised gain; an advantage counts above this.
  duration time_to_trigger = std::chrono::milliseconds{500}; ///< For so long.
  duration dwell = std::chrono::seconds{2}; ///< Between switches, at least.
};

/// Follows a scorer's wish only when it has been better than the present source
/// by more than the margin for the time to trigger, without a break, and the
/// last switch is a dwell ago. A fallback is never delayed: it happens in the
/// call that asks for it, and is a switch after which others dwell.
/// Model: event A3 of 3GPP TS 36.331 (neighbour better by an offset for a
/// time), with a dwell in addition.
class hysteresis {
public:
  struct wish {
    service_place source{};
    double advantage = 0;        ///< Over the present source, normalised.
    bool must_fall_back = false; ///< Home at once, whatever is better.
  };

  explicit hysteresis(const hysteresis_options& options = {})
      : options_{options} {}

  /// @param now  Not before the last call's.
  /// @returns the source from now on.
  service_place next(const wish& wanted, time_point now);

  service_place source() const { return source_; }

  /// The source has changed without being asked, or not changed though asked.
  /// @param since  When it came there.
  void is_at(service_place source, time_point since) {
    if (source != source_)
      switch_to(source, since);
  }

private:
  void switch_to(service_place source, time_point now);

  hysteresis_options options_;
  service_place source_;
  service_place challenger_;
  std::optional<time_point> better_since_; // of the challenger
  std::optional<time_point> switched_;
};

} // namespace sofof::policies
