// Means with their uncertainty.
#pragma once

#include "base/random.hpp"

#include <optional>
#include <span>

namespace sofof::experiments::study {

/// A mean of all values together, and where it lies with 95 % confidence.
struct interval {
  double mean = 0;
  double low = 0;
  double high = 0;
};

/// Values that belong together, those of one run, say.
struct group {
  double sum = 0;
  double count = 0;
};

/// The mean of all values of all groups, not of the groups' means, and its
/// percentile bootstrap interval: groups are drawn with replacement, so that
/// values of one group may depend on each other.
/// @param noise  A stream of its own; the same stream, the same interval.
/// @returns nullopt without values. Of a single group the interval is its mean.
/// Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, ch. 13.
std::optional<interval> bootstrap(std::span<const group> groups,
                                  const random_stream& noise);

} // namespace sofof::experiments::study
