// A smooth curve through noisy values and slopes.
#pragma once

#include <array>
#include <cstddef>

namespace sofof {

/// A cubic spline over equal steps that fits observations in the sense of
/// least squares, where kinks (jumps of its third derivative at knots) cost.
/// Normal equations of bandwidth 4, no heap, O(steps).
/// Source: Eilers & Marx 1996, Flexible smoothing with B-splines and
/// penalties.
class smooth_curve {
public:
  static constexpr std::size_t most_steps = 160;

  /// Begins a new curve over [0, steps · step].
  /// @param steps  1..most_steps.
  /// @param step   > 0.
  void begin(std::size_t steps, double step);

  // Observations; `x` within the curve's ends, weights are 1 / variance.
  void observe_value(double x, double value, double weight);
  void observe_slope(double x, double slope, double weight);
  /// Of the second derivative at a knot.
  void observe_bend(std::size_t knot, double bend, double weight);
  /// Of the jump of the third derivative at a knot.
  /// @param knot  1..steps - 1.
  void observe_kink(std::size_t knot, double kink, double weight);

  /// To be called once.
  /// @returns false when the observations do not determine a curve.
  bool solve();

  struct place {
    double value = 0, slope = 0, bend = 0;
  };
  place at(double x) const;
  place at_knot(std::size_t knot) const;

private:
  static constexpr std::size_t band = 5; // the diagonal and one side of it
  static constexpr std::size_t most_rows = most_steps + 3;

  struct spot {
    std::size_t knot;
    double share;
  };
  spot find(double x) const;
  template <std::size_t N>
  void observe(std::size_t first, const std::array<double, N>& row,
               double value, double weight);

  std::size_t steps_ = 0;
  double per_step_ = 1;
  // Room for the elimination to run over the end. The matrix is symmetric:
  // its lower triangle by columns, then the factors of it.
  std::array<std::array<double, band>, most_rows + band> matrix_;
  std::array<double, most_rows + band> side_; // right-hand, then coefficients
};

} // namespace sofof
