// What capacities are worth, and how much an assignment can be worth at most.
#pragma once

#include "policies/algorithms/assignment/reduced_problem.hpp"

namespace sofof::policies::assignment {

/// Prices for shares of capacity. Were capacities sold at these prices instead
/// of limited, every vehicle would choose for itself, and all together would
/// win no less than under the limits (Lagrangian relaxation):
///
///   bound(λ) = Σ_ik λ_ik + Σ_j max(0, max_i a_ij − Σ_k λ_ik s_ijk)
///
/// with advantages a and shares s. The least bound is that of the problem with
/// fractions of vehicles.
struct lagrangian_bound {
  /// λ ≥ 0: providers × resources, for a whole capacity.
  Eigen::ArrayXXd prices;
  /// No feasible assignment has advantages of a greater sum.
  double bound = 0;
};

/// @returns what is left of an advantage when the shares are paid for.
double margin(const reduced_problem& s, const Eigen::ArrayXXd& prices,
              int vehicle, int provider);

/// Seeks prices with a low bound by the subgradient method with Polyak's steps;
/// stops after 300, or when the bound is met.
/// @param reached  Sum of advantages of some feasible assignment.
/// Source: Held, Wolfe & Crowder, Mathematical Programming 6 (1974).
lagrangian_bound price_capacities(const reduced_problem& s, double reached);

} // namespace sofof::policies::assignment
