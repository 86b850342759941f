// Means with their uncertainty.
#pragma once

#include "base/random.hpp"
#include "experiments/dehler2025/interval.hpp"

#include <optional>
#include <span>

namespace sofof::experiments::study {

/// The mean of all values of all groups, not of the groups' means, and its
/// percentile bootstrap interval: groups are drawn with replacement, so that
/// values of one group may depend on each other.
/// @param noise  A stream of its own; the same stream, the same interval.
/// @returns nullopt without values. Of a single group the interval is its mean.
/// What was not drawn does not count, so what is rare wants `mean_interval`.
/// Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, ch. 13.
std::optional<interval> bootstrap(std::span<const group> groups,
                                  const random_stream& noise);

} // namespace sofof::experiments::study
