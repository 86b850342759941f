// One vehicle and its latencies, without a simulation: what offloading times
// hang on.
#pragma once

#include <cstdint>
#include <vector>

namespace sofof::experiments::study {

/// Latencies between 0 and a longest one, with a mean and a deviation: a scaled
/// beta distribution, as `paper_sim` has (docs/channels.md).
class bounded_latency {
public:
  /// @param longest_ms  Beyond the mean by more than a few deviations, so that
  ///                    the density has no pole at its upper end.
  bounded_latency(double mean_ms, double deviation_ms, double longest_ms);

  /// @param share  In [0, 1].
  /// @returns the latency below which this share of all lies, ms.
  double quantile_ms(double share) const;

  /// @returns the share above a latency.
  double share_above(double ms) const;

private:
  double longest_ms_;
  double shape_;               ///< The first of the beta distribution.
  std::vector<double> shares_; ///< Below evenly spaced powers x^shape_.
};

/// What a vehicle meets while it is in the area.
struct pass_model {
  double period_ms = 50;
  double pass_s = 70; ///< The time in the area.
  double pause_s = 1; ///< From an early end to the next offloading.
  double max_latency_ms = 50;
  double max_interarrival_ms = 100;
  double correlation = 0; ///< Of one latency with the next, 0 … 1.
  std::uint64_t passes = 300;
};

/// Results every period, each late by a latency, none before an earlier one. An
/// offloading begins with a result in time, and ends with the pass, with one
/// that is too late, or when none comes for too long. Latencies that depend on
/// each other keep their distribution (a Gaussian copula of first order).
/// @returns the mean offloading time, s; 0 without one.
double mean_t_off_s(const bounded_latency& law, const pass_model& pass);

/// The real drives' channel, `paper_5g`, with another least delay: the rest of
/// the network's delay is log-normal, so that mean and deviation of the whole
/// stay the paper's 11.94 ± 2.98 ms.
/// @param least_ms  Of the network, less than 8.7.
/// @param results   Of a drive.
/// @returns the probability that a drive has a result later than `limit_ms`.
double share_of_drives_with_a_late_result(double least_ms, double limit_ms,
                                          double results);

} // namespace sofof::experiments::study
