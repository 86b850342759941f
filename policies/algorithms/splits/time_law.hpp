// How long something takes, as measured, and how long several things take one
// after the other.
#pragma once

#include "base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace sofof::policies {

/// The probabilities of a time, in steps of 1 ms up to 1 s; what is longer
/// counts as 1 s.
class time_law {
public:
  static constexpr duration step = std::chrono::milliseconds{1};
  static constexpr std::size_t most_steps = 1000;

  /// Unknown: no time has been measured.
  time_law() = default;

  static time_law exactly(duration d);
  /// Any time up to this, each as likely.
  static time_law uniform(duration longest);

  /// A normal time that is at least zero and at most `longest`.
  static time_law normal(duration mean, duration deviation, duration longest);

  /// One more time has been measured; below zero counts as zero.
  void add(duration d);

  bool is_known() const { return count_ > 0; }
  double count() const { return count_; }
  std::optional<duration> mean() const;
  /// @param p  In (0, 1].
  /// @returns the least step that a share p of all times does not exceed;
  /// nullopt if unknown.
  std::optional<duration> quantile(double p) const;

  /// The law of both, one after the other, if neither depends on the other;
  /// unknown if one of them is.
  friend time_law after(const time_law& x, const time_law& y);

  /// The law of what ends with the next of moments that are `period` apart, if
  /// it begins with one of them.
  /// @param period  A multiple of `step`, > 0.
  friend time_law until_multiple_of(duration period, const time_law& x);

private:
  std::vector<double> weights_; // of [k − 1/2, k + 1/2) steps
  double count_ = 0;            // of them together
};

time_law until_multiple_of(duration period, const time_law& x);

} // namespace sofof::policies
