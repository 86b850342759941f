// A smooth curve through noisy values and slopes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace sofof::messages {

/// A cubic spline over equal steps that fits observations in the sense of
/// least squares, where kinks (jumps of its third derivative at knots) cost.
/// Normal equations of bandwidth 4, no heap, O(steps).
/// Source: Eilers & Marx 1996, Flexible smoothing with B-splines and
/// penalties.
class p_spline {
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
  /// That the second derivative is 0 at knots.
  /// @param weights  For every knot, of 0..steps.
  void expect_no_bends(std::span<const double> weights);
  /// Of the jump of the third derivative at the knots between steps.
  /// @param weights, kinks  For the knots 1..steps - 1.
  void expect_kinks(std::span<const double> weights,
                    std::span<const double> kinks);
  /// That it is 0 there.
  void expect_no_kinks(std::span<const double> weights);

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
  // Room for the elimination to run over the end.
  using column = std::array<double, most_rows + band>;

  struct spot {
    std::size_t knot;
    double share;
  };
  spot find(double x) const;
  template <std::size_t N>
  void observe(std::size_t first, const std::array<double, N>& row,
               double value, double weight);
  template <std::size_t N>
  void observe_each(const std::array<double, N>& row,
                    std::span<const double> weights);

  std::size_t steps_ = 0;
  double per_step_ = 1;
  // The matrix is symmetric: its diagonals, then those of its factors.
  std::array<column, band> diagonals_;
  column side_; // right-hand, then coefficients
};

// Inline, for they are called for every point.

inline p_spline::spot p_spline::find(double x) const {
  const auto last = static_cast<double>(steps_ - 1);
  const auto along = x * per_step_;
  // Also for what is no number.
  const auto knot = along > 0 ? std::min(along, last) : 0.0;
  const auto k = static_cast<std::size_t>(knot);
  return {k, along - static_cast<double>(k)};
}

template <std::size_t N>
void p_spline::observe(std::size_t first, const std::array<double, N>& row,
                       double value, double weight) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto weighted = weight * row[i];
    for (std::size_t j = i; j < N; ++j)
      diagonals_[j - i][first + i] += weighted * row[j];
    side_[first + i] += weighted * value;
  }
}

inline void p_spline::observe_value(double x, double value, double weight) {
  const auto [k, u] = find(x);
  const auto r = 1 - u;
  constexpr double sixth = 1.0 / 6;
  observe(k,
          std::array{sixth * r * r * r, sixth * (4 - 3 * u * u * (1 + r)),
                     sixth * (4 - 3 * r * r * (1 + u)), sixth * u * u * u},
          value, weight);
}

inline void p_spline::observe_slope(double x, double slope, double weight) {
  const auto [k, u] = find(x);
  const auto r = 1 - u, half = per_step_ / 2;
  observe(k,
          std::array{-half * r * r, half * u * (3 * u - 4),
                     half * r * (4 - 3 * r), half * u * u},
          slope, weight);
}

inline void p_spline::observe_bend(std::size_t knot, double bend,
                                   double weight) {
  const auto c = per_step_ * per_step_;
  observe(knot, std::array{c, -2 * c, c}, bend, weight);
}

inline p_spline::place p_spline::at(double x) const {
  const auto [k, u] = find(x);
  const auto r = 1 - u;
  const auto* c = &side_[k];
  constexpr double sixth = 1.0 / 6;
  return {sixth
              * (c[0] * r * r * r + c[1] * (4 - 3 * u * u * (1 + r))
                 + c[2] * (4 - 3 * r * r * (1 + u)) + c[3] * u * u * u),
          per_step_ / 2
              * (-c[0] * r * r + c[1] * u * (3 * u - 4) + c[2] * r * (4 - 3 * r)
                 + c[3] * u * u),
          per_step_ * per_step_
              * (r * (c[0] - 2 * c[1] + c[2]) + u * (c[1] - 2 * c[2] + c[3]))};
}

inline p_spline::place p_spline::at_knot(std::size_t knot) const {
  const auto* c = &side_[knot];
  constexpr double sixth = 1.0 / 6;
  return {sixth * (c[0] + 4 * c[1] + c[2]), per_step_ / 2 * (c[2] - c[0]),
          per_step_ * per_step_ * (c[0] - 2 * c[1] + c[2])};
}

} // namespace sofof::messages
