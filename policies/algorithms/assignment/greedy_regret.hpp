// A good assignment at once: first those who would lose most by waiting.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"

namespace sofof::policies::assignment {

/// Serves next whoever loses most if its best provider with room were gone:
/// once by advantage, once by advantage per share of capacity, and once by what
/// is left of it at the prices of lagrangian_bound.hpp. Improves each by moving
/// vehicles and by exchanging the choices of two as long as that helps, and
/// returns the best. Ties go to the lower index.
///
/// Feasible, and never worse than everybody local; no bound on its distance
/// from the optimum (with one resource and room for 60 %, 1 % in the mean and
/// 7 % at worst). O(N² M) and O(N²) a round of exchanges.
/// @throws std::invalid_argument as check() does.
/// Source: Martello & Toth, Knapsack Problems (1990), section 7.4, procedure
/// MTHG; there every item must be assigned, here the rest stays local. Prices
/// and exchanges are ours.
solution greedy_regret(const problem& p);

} // namespace sofof::policies::assignment
