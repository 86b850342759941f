// The best assignment, with a proof.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"

#include <cstdint>

namespace sofof::policies::assignment {

struct proved_solution {
  /// The best that was found; feasible.
  solution best;
  /// Whether nothing is better, up to 1e-9 of the greatest single advantage.
  bool proved = false;
  /// No feasible assignment is worth more; the best value when proved.
  double bound = 0;
  /// Partial assignments that were looked at.
  std::int64_t nodes = 0;
};

/// Decides about one vehicle after the other, those first whose choice is
/// clearest, and drops a partial assignment that cannot become better than the
/// best so far, which is greedy_regret's at first. What it can become follows
/// from prices for what is left of the capacities (lagrangian_bound.hpp). Who
/// leans on another one is decided after it; the bounds do not know of losses.
///
/// Deterministic; exponential at worst, so it gives up after some nodes and
/// returns what it has. A node costs O(M). Of problems with 40 vehicles, 3
/// providers and room for 60 %, one in 200 needs more than a million nodes with
/// one resource, and 70 % do with two.
/// @param node_limit  ≥ 0.
/// @throws std::invalid_argument as check() does.
/// Source: Fisher, Management Science 27(1) (1981); Martello & Toth, Knapsack
/// Problems (1990), chapter 7.
proved_solution branch_and_bound(const problem& p,
                                 std::int64_t node_limit = 1'000'000);

} // namespace sofof::policies::assignment
