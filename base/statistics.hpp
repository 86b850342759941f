// Mean, spread and quantiles of a stream of numbers, in constant memory.
#pragma once

#include "base/time.hpp"

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace sofof {

/// Mean and spread of numbers that are seen once. Exact but for rounding.
/// Source: Welford, Technometrics 4(3), 1962.
class statistics {
public:
  void add(double x);

  std::uint64_t count() const { return count_; }
  double sum() const { return mean_ * static_cast<double>(count_); }
  /// @returns nullopt without numbers.
  std::optional<double> mean() const;
  /// @returns the sample standard deviation (divisor count − 1); nullopt for
  /// fewer than two numbers.
  std::optional<double> deviation() const;
  /// @returns nullopt without numbers.
  std::optional<double> max() const;

private:
  std::uint64_t count_ = 0;
  double mean_ = 0;
  double squares_ = 0; ///< Sum of squared distances from the mean.
  double max_ = 0;
};

/// Distribution of durations, in milliseconds: statistics, and quantiles
/// from a histogram of fixed resolution.
class distribution {
public:
  /// Those of latencies.
  static constexpr duration resolution = std::chrono::microseconds{10};
  static constexpr duration span = std::chrono::seconds{10};

  distribution() = default;
  /// @param step    Quantiles are rounded up to a multiple of this; > 0.
  /// @param widest  Beyond it a quantile is only known to be the maximum or
  ///                less.
  distribution(duration step, duration widest)
      : resolution_{step}, span_{widest} {
    assert(step > duration{0});
  }

  void add(duration d);

  const statistics& ms() const { return ms_; }

  /// @param p  0 < p ≤ 1.
  /// @returns the smallest multiple of the resolution that a share p of all
  /// durations does not exceed, ms, but never more than the maximum; the
  /// maximum when it lies beyond the span; nullopt without durations.
  std::optional<double> quantile_ms(double p) const;

  /// How many durations there were up to a bound.
  struct bin {
    double up_to_ms;     ///< And above the bound of the bin before.
    std::uint64_t count; ///< Above zero.
  };

  /// @param width  A multiple of the resolution.
  /// @returns the bins of this width that are not empty, ascending; durations
  /// beyond the span stand in a last one, up to the maximum.
  std::vector<bin> bins(duration width) const;

private:
  duration resolution_ = resolution;
  duration span_ = span;
  statistics ms_;
  /// Bin k counts durations in (k − 1, k] · resolution, bin 0 all up to 0;
  /// as long as the largest duration within the span needs it.
  std::vector<std::uint64_t> bins_;
};

} // namespace sofof
