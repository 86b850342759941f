// A normal law that follows a stream of numbers.
#pragma once

#include <cassert>
#include <cstddef>

namespace sofof::policies {

/// Mean and variance with exponentially fading weights:
///
///     d = x − m;  m ← m + a d;  v ← (1 − a)(v + a d²)
///
/// with a = max(α, 1/n) at the n-th number: the first 1/α numbers weigh the
/// same, and m and v are their plain mean and variance, so that the very first
/// is not remembered for longer than others.
/// Source: Wodtko et al. 2025 (IV), whose start is another.
class moving_normal {
public:
  /// @param alpha  Weight of the newest number, in (0, 1].
  explicit moving_normal(double alpha) : alpha_{alpha} {
    assert(alpha > 0 && alpha <= 1);
  }

  /// Learns from a number; one that is not finite is ignored.
  /// @param times  As how many equal ones in a row it counts, ≥ 1: then a is
  ///               1 − (1 − α)^times, at least 1/n.
  void add(double x, double times = 1);

  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const { return variance_; }

  /// @returns P(next > limit); without any spread 0 or 1.
  double probability_above(double limit) const;

  /// @param p  In (0, 1).
  /// @returns what the next number stays below with probability p.
  double quantile(double p) const;

private:
  double alpha_;
  std::size_t count_ = 0;
  double mean_ = 0;
  double variance_ = 0;
};

} // namespace sofof::policies
