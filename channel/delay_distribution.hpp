// Distributions of durations, drawn by number.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"

#include <cstdint>

namespace sofof::channel {

/// How long something takes, at random: a shift plus one of a few shapes.
/// The default takes no time at all.
class delay_distribution {
public:
  delay_distribution() = default;
  static delay_distribution uniform(duration low, duration high);
  static delay_distribution exponential(duration mean);
  /// @param mean, sd  Mean > 0 and standard deviation of the log-normal part,
  ///                  without the shift.
  static delay_distribution lognormal(duration shift, duration mean,
                                      duration sd);
  /// @param scale  Median of the log-normal part, > 0.
  /// @param sigma  Standard deviation of its logarithm.
  static delay_distribution lognormal_about(duration shift, duration scale,
                                            double sigma);
  /// `longest` times a beta(a, b) variable.
  static delay_distribution beta(duration longest, double a, double b);

  /// @returns whether it takes no time at all, whatever is drawn.
  bool is_none() const { return kind_ == shape::none; }

  /// @returns draw `number` of this law, s, >= 0.
  double draw_s(const random_stream& stream, std::uint64_t number,
                std::uint32_t lane) const {
    return is_none() ? 0 : draw_some_s(stream, number, lane);
  }

  /// @returns the mean of this law, s, >= 0.
  double mean_s() const;

  /// @returns its standard deviation, s.
  double deviation_s() const;

private:
  enum class shape { none, uniform, exponential, lognormal, beta };

  double draw_some_s(const random_stream& stream, std::uint64_t number,
                     std::uint32_t lane) const;

  delay_distribution(shape kind, duration shift, double p, double q = 0,
                     double r = 0)
      : kind_{kind}, shift_s_{to_seconds(shift)}, p_{p}, q_{q}, r_{r} {}

  shape kind_ = shape::none;
  double shift_s_ = 0;
  double p_ = 0; // in the order of the arguments of the shape's draw
  double q_ = 0;
  double r_ = 0;
};

} // namespace sofof::channel
