// What is won by planning elsewhere: time, energy, and the risk of violations
// on one scale.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "world/vehicle/cycle_cost.hpp"

namespace sofof::policies {

/// What a service asks of its results.
struct service_needs {
  duration period{};
  duration max_latency{};      ///< From the begin of a cycle to its result.
  duration max_interarrival{}; ///< Between two results.
  /// The longest time from what a sensor sees to the first result that depends
  /// on it while a provider computes the service, as long as limits are kept,
  /// and until the vehicle's own function has taken over when they are not; of
  /// services that make a chain, to the result of the last one, with the others
  /// where they are. duration::max(): they do not bound it.
  duration worst_response = duration::max();
};

/// What the parts of a cost count, without unit, each ≥ 0.
struct cost_weights {
  double time = 0.3;    ///< λ_T, of latency in parts of its limit.
  double energy = 0.3;  ///< λ_E, of energy in parts of a cycle on board.
  double violation = 1; ///< λ_V, of the probability to be late.
};

/// What a cycle costs, without unit: λ_T T/τ + λ_E E/E_ref + λ_V P(T > τ).
/// @param cost         Its time from begin to result, and its energy.
/// @param late         P(T > τ), in [0, 1].
/// @param reference_j  E_ref; 0: energy does not count.
/// Source: weighted sums of time and energy as in Chen et al., ToN 24(5) 2016,
/// eqs. (4) and (8); the risk is ours.
constexpr double weighed(const world::cycle_cost& cost, double late,
                         const service_needs& needs, double reference_j,
                         const cost_weights& weights = {}) {
  const auto limit_s = to_seconds(needs.max_latency);
  const auto time = limit_s > 0 ? cost.time_s / limit_s : 0;
  const auto energy = reference_j > 0 ? cost.energy_j / reference_j : 0;
  return weights.time * time + weights.energy * energy
         + weights.violation * late;
}

} // namespace sofof::policies
