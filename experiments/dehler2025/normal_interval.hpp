// Means of few runs whose values are spread as measurement errors are.
#pragma once

#include "experiments/dehler2025/interval.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace sofof::experiments::study {

/// @param degrees  Of freedom, >= 1.
/// @returns the t that Student's distribution exceeds in magnitude in 5 of 100
/// cases. Source: Abramowitz & Stegun, Handbook of Mathematical Functions,
/// 1964, eqs. 26.7.3 and 26.7.4, solved by bisection.
double student_t_95(std::size_t degrees);

/// The mean of all values of all groups, and its 95 % interval by Student's t,
/// which is exact for groups of equal weight whose means are distributed
/// normally. For few groups, whose `mean_interval` would be too narrow.
/// @returns nullopt for fewer than two groups with values.
std::optional<interval> normal_mean_interval(std::span<const group> groups);

} // namespace sofof::experiments::study
