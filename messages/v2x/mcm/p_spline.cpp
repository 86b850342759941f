// Cubic B-splines and a banded LDL' factorisation.
#include "messages/v2x/mcm/p_spline.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::messages {

void p_spline::begin(std::size_t steps, double step) {
  assert(step > 0);
  steps_ = std::clamp(steps, std::size_t{1}, most_steps);
  per_step_ = 1 / step;
  for (auto& diagonal : diagonals_)
    std::fill_n(diagonal.begin(), steps_ + 3 + band, 0.0);
  std::fill_n(side_.begin(), steps_ + 3 + band, 0.0);
}

/// The same row, one column later for every next weight. Several at a time:
/// one observation after the other would wait for what the last one wrote.
template <std::size_t N>
void p_spline::observe_each(const std::array<double, N>& row,
                            std::span<const double> weights) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i; j < N; ++j) {
      const auto share = row[i] * row[j];
      auto* const out = &diagonals_[j - i][i];
#pragma omp simd
      for (std::size_t k = 0; k < weights.size(); ++k)
        out[k] += share * weights[k];
    }
}

void p_spline::expect_no_bends(std::span<const double> weights) {
  assert(weights.size() == steps_ + 1);
  const auto c = per_step_ * per_step_;
  observe_each(std::array{c, -2 * c, c}, weights);
}

namespace {

/// A kink by the spline's coefficients about it.
std::array<double, 5> kink_row(double per_step) {
  const auto c = per_step * per_step * per_step;
  return {c, -4 * c, 6 * c, -4 * c, c};
}

} // namespace

void p_spline::expect_no_kinks(std::span<const double> weights) {
  assert(weights.size() + 1 == steps_);
  observe_each(kink_row(per_step_), weights);
}

void p_spline::expect_kinks(std::span<const double> weights,
                            std::span<const double> kinks) {
  assert(kinks.size() >= weights.size());
  expect_no_kinks(weights);
  const auto row = kink_row(per_step_);
  for (std::size_t i = 0; i < row.size(); ++i)
#pragma omp simd
    for (std::size_t k = 0; k < weights.size(); ++k)
      side_[k + i] += row[i] * weights[k] * kinks[k];
}

bool p_spline::solve() {
  auto& [a, b, c, d, e] = diagonals_;
  const auto rows = steps_ + 3;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!(a[k] > 0))
      return false;
    const auto inverse = 1 / a[k];
    const auto b1 = b[k], c1 = c[k], d1 = d[k], e1 = e[k], y = side_[k];
    // The next pivot waits for this one: not for its inverse, too.
    a[k + 1] -= b1 * b1 / a[k];
    side_[k] = inverse * y;
    b[k] = inverse * b1, c[k] = inverse * c1;
    d[k] = inverse * d1, e[k] = inverse * e1;
    b[k + 1] -= b[k] * c1, c[k + 1] -= b[k] * d1, d[k + 1] -= b[k] * e1;
    a[k + 2] -= c[k] * c1, b[k + 2] -= c[k] * d1, c[k + 2] -= c[k] * e1;
    a[k + 3] -= d[k] * d1, b[k + 3] -= d[k] * e1;
    a[k + 4] -= e[k] * e1;
    side_[k + 1] -= b[k] * y, side_[k + 2] -= c[k] * y;
    side_[k + 3] -= d[k] * y, side_[k + 4] -= e[k] * y;
  }
  // Those behind the end are 0.
  for (auto k = rows; k-- > 0;) {
    side_[k] -= e[k] * side_[k + 4];
    side_[k] -= d[k] * side_[k + 3];
    side_[k] -= c[k] * side_[k + 2];
    side_[k] -= b[k] * side_[k + 1]; // last, for it comes last
  }
  return true;
}

} // namespace sofof::messages
