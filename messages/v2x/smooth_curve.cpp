// Cubic B-splines and a banded LDL' factorisation.
#include "messages/v2x/smooth_curve.hpp"

#include <algorithm>

namespace sofof {

void smooth_curve::begin(std::size_t steps, double step) {
  steps_ = std::clamp(steps, std::size_t{1}, most_steps);
  per_step_ = 1 / step;
  std::fill_n(matrix_.begin(), steps_ + 3 + band, std::array<double, band>{});
  std::fill_n(side_.begin(), steps_ + 3 + band, 0.0);
}

smooth_curve::spot smooth_curve::find(double x) const {
  const auto last = static_cast<double>(steps_ - 1);
  const auto along = x * per_step_;
  // Also for what is no number.
  const auto knot = along > 0 ? std::min(along, last) : 0.0;
  const auto k = static_cast<std::size_t>(knot);
  return {k, along - static_cast<double>(k)};
}

template <std::size_t N>
void smooth_curve::observe(std::size_t first, const std::array<double, N>& row,
                           double value, double weight) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto weighted = weight * row[i];
    auto& column = matrix_[first + i];
    for (std::size_t j = i; j < N; ++j)
      column[j - i] += weighted * row[j];
    side_[first + i] += weighted * value;
  }
}

void smooth_curve::observe_value(double x, double value, double weight) {
  const auto [k, u] = find(x);
  const auto r = 1 - u;
  observe(k,
          std::array{r * r * r / 6, (4 - 3 * u * u * (1 + r)) / 6,
                     (4 - 3 * r * r * (1 + u)) / 6, u * u * u / 6},
          value, weight);
}

void smooth_curve::observe_slope(double x, double slope, double weight) {
  const auto [k, u] = find(x);
  const auto r = 1 - u, half = per_step_ / 2;
  observe(k,
          std::array{-half * r * r, half * u * (3 * u - 4),
                     half * r * (4 - 3 * r), half * u * u},
          slope, weight);
}

void smooth_curve::observe_bend(std::size_t knot, double bend, double weight) {
  const auto c = per_step_ * per_step_;
  observe(knot, std::array{c, -2 * c, c}, bend, weight);
}

void smooth_curve::observe_kink(std::size_t knot, double kink, double weight) {
  const auto c = per_step_ * per_step_ * per_step_;
  observe(knot - 1, std::array{c, -4 * c, 6 * c, -4 * c, c}, kink, weight);
}

bool smooth_curve::solve() {
  const auto rows = steps_ + 3;
  for (std::size_t k = 0; k < rows; ++k) {
    auto& column = matrix_[k];
    if (!(column[0] > 0))
      return false;
    const auto inverse = 1 / column[0];
    for (std::size_t i = 1; i < band; ++i) {
      const auto factor = column[i] * inverse;
      auto& target = matrix_[k + i];
      for (std::size_t j = i; j < band; ++j)
        target[j - i] -= factor * column[j];
      side_[k + i] -= factor * side_[k];
    }
    for (std::size_t i = 1; i < band; ++i)
      column[i] *= inverse;
    side_[k] *= inverse;
  }
  for (auto k = rows; k-- > 0;)
    for (std::size_t i = 1; i < band && k + i < rows; ++i)
      side_[k] -= matrix_[k][i] * side_[k + i];
  return true;
}

smooth_curve::place smooth_curve::at(double x) const {
  const auto [k, u] = find(x);
  const auto r = 1 - u;
  const auto* c = &side_[k];
  return {(c[0] * r * r * r + c[1] * (4 - 3 * u * u * (1 + r))
           + c[2] * (4 - 3 * r * r * (1 + u)) + c[3] * u * u * u)
              / 6,
          per_step_ / 2
              * (-c[0] * r * r + c[1] * u * (3 * u - 4) + c[2] * r * (4 - 3 * r)
                 + c[3] * u * u),
          per_step_ * per_step_
              * (r * (c[0] - 2 * c[1] + c[2]) + u * (c[1] - 2 * c[2] + c[3]))};
}

smooth_curve::place smooth_curve::at_knot(std::size_t knot) const {
  const auto* c = &side_[knot];
  return {(c[0] + 4 * c[1] + c[2]) / 6, per_step_ / 2 * (c[2] - c[0]),
          per_step_ * per_step_ * (c[0] - 2 * c[1] + c[2])};
}

} // namespace sofof
