// What to expect of a link: how late the next message, how long the next gap.
#pragma once

#include "base/time.hpp"
#include "policies/algorithms/forecast/moving_normal.hpp"

#include <cstddef>
#include <optional>

namespace sofof::policies {

struct link_estimator_options {
  double alpha = 0.05;      ///< Weight of the newest message, in (0, 1].
  double stale_periods = 3; ///< So many without a message: it knows nothing.
  std::size_t least_count = 10; ///< Messages before it says anything, ≥ 2.
  /// Of results. Answers, which are rarer, count for the results that could
  /// have come since the last message, up to `most_missed`.
  duration period = std::chrono::milliseconds{50};
  double most_missed = 10; ///< ≥ 1.
};

/// Follows the messages of one provider: results, and while there are none its
/// offers, which answer CAMs. Latency as lognormal, the period between results
/// as normal, both with fading weights. What it does not know it calls certain
/// to go wrong: before `least_count` messages, and when the link has been
/// silent for `stale_periods` mean periods of what came last, every probability
/// is 1.
///
/// It sees only what arrives: loss shows as gaps, and as latency never. A rare
/// outlier that nothing announces is beyond any forecast from the past.
/// O(1) in time and memory. Source: Wodtko et al. 2025 (IV), α = 0.05.
class link_estimator {
public:
  explicit link_estimator(const link_estimator_options& options = {});

  /// Learns from a result. A latency below 1 µs counts as 1 µs, as clocks of
  /// two hosts disagree; a message that arrived before the last one is ignored.
  /// @param created   When it was made, on our clock as far as that is known;
  ///                  plausible (`is_plausible`).
  /// @param received  When it arrived.
  void arrived(time_point created, time_point received);

  /// Learns from an answer, likewise.
  /// @param created  Before it was sent by as long as a result is computed.
  void answered(time_point created, time_point received);

  /// @returns when the last message came; nullopt before the first.
  std::optional<time_point> last() const { return last_; }

  /// @returns whether too little is known for a forecast at this time.
  bool stale(time_point now) const;

  /// @returns P(latency of the next message > limit), in [0, 1]; 1 if stale.
  double late_probability(duration limit, time_point now) const;

  /// @returns P(gap to the next arrival > limit), in [0, 1]; 1 if stale.
  double gap_probability(duration limit, time_point now) const;

  /// @param p  In (0, 1).
  /// @returns the latency that the next message stays below with probability
  /// p, at most a day; nullopt before `least_count` messages.
  std::optional<duration> latency_quantile(double p) const;

  /// The same of the gap between arrivals, ≥ 0.
  std::optional<duration> gap_quantile(double p) const;

private:
  bool known() const { return log_latency_.count() >= options_.least_count; }
  void learn(time_point created, time_point received, double times);

  link_estimator_options options_;
  moving_normal log_latency_; // ln s
  moving_normal gap_s_;
  moving_normal answer_gap_s_;
  std::optional<time_point> last_;
  std::optional<time_point> last_answer_;
  std::optional<time_point> last_result_;
};

} // namespace sofof::policies
