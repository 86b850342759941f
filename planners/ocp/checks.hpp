// Whether numbers that come from outside can be computed with.
#pragma once

#include <cstddef>
#include <span>

namespace sofof::planners::ocp {

/// @returns whether all numbers are finite.
inline bool all_finite(std::span<const double> values) {
  const auto* x = values.data();
  const auto n = values.size();
  double sum = 0; // of x - x, which is NaN for all others
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i)
    sum += x[i] - x[i];
  return sum == 0;
}

/// @returns whether any number is finite; none may be NaN.
inline bool any_finite(std::span<const double> values) {
  const auto* x = values.data();
  const auto n = values.size();
  double count = 0;
#pragma omp simd reduction(+ : count)
  for (std::size_t i = 0; i < n; ++i)
    count += x[i] - x[i] == 0 ? 1. : 0.;
  return count > 0;
}

/// @returns whether all numbers are at least `least`; NaN is not.
inline bool all_at_least(std::span<const double> values, double least) {
  const auto* x = values.data();
  const auto n = values.size();
  double bad = 0;
#pragma omp simd reduction(+ : bad)
  for (std::size_t i = 0; i < n; ++i)
    bad += x[i] >= least ? 0. : 1.;
  return bad == 0;
}

/// @returns whether none is NaN; infinities may be.
inline bool no_nan(std::span<const double> values) {
  const auto* x = values.data();
  const auto n = values.size();
  double bad = 0;
#pragma omp simd reduction(+ : bad)
  for (std::size_t i = 0; i < n; ++i)
    bad += x[i] == x[i] ? 0. : 1.;
  return bad == 0;
}

} // namespace sofof::planners::ocp
