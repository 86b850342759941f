// The best assignment by COIN-OR's branch and cut, where it is built in.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"

#include <cstdint>
#include <optional>

namespace sofof::policies::assignment {

/// Solves the problem as a mixed-integer program with CBC, one call at a time,
/// until the optimum is proved. Slower than `branch_and_bound` with one
/// resource, and without its limit to what can be proved with two. Only in
/// builds with SOFOF_WITH_CBC.
/// @param node_limit  Of its search, ≥ 0.
/// @returns the optimum; nullopt when CBC ends without one, or with one that
/// is not feasible() by its looser tolerances, or in which somebody is alone
/// who leans on another one.
/// @throws std::invalid_argument as check() does.
/// Source: Forrest & Lougee-Heimer, CBC User Guide, INFORMS Tutorials (2005).
std::optional<solution> cbc(const problem& p,
                            std::int64_t node_limit = 1'000'000);

} // namespace sofof::policies::assignment
