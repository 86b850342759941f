// When a learner tries something that it does not hold for the best.
#pragma once

#include "base/random.hpp"
#include "policies/algorithms/learning/action_set.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace sofof::policies {

/// The share of random decisions, which falls in a straight line.
struct exploration {
  double first = 0.1;                ///< At the first decision, 0..1.
  double last = 0.01;                ///< From then on, 0..1.
  std::uint64_t decisions = 100'000; ///< From first to last, > 0.

  /// @returns the share after so many decisions.
  double share(std::uint64_t decisions_taken) const;

  friend bool operator==(const exploration&, const exploration&) = default;
};

/// @param values   One per action, at most 32.
/// @param allowed  Others are never chosen.
/// @returns the allowed action of the highest value, of equals the first;
/// nullopt when none is allowed.
std::optional<std::size_t> best_action(std::span<const double> values,
                                       action_set allowed);

/// Takes the best action, or with probability `share` any of the allowed.
/// @param decision  The counter of this decision's draws.
/// @returns nullopt when none is allowed.
/// Source: Sutton & Barto 2018, section 2.2 (ε-greedy).
std::optional<std::size_t> explore_or_best(std::span<const double> values,
                                           action_set allowed, double share,
                                           const random_stream& draws,
                                           std::uint64_t decision);

} // namespace sofof::policies
