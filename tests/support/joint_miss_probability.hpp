// How often several providers miss the same cycle.
#pragma once

#include <span>

namespace sofof::test {

/// @param misses  Probability of each provider to miss a cycle, in [0, 1].
/// @returns the probability that all miss it, if they do so independently of
/// each other; links that share a radio do not, and miss more often.
inline double joint_miss_probability(std::span<const double> misses) {
  double joint = 1;
  for (const auto p : misses)
    joint *= p;
  return joint;
}

} // namespace sofof::test
