// What is won by planning elsewhere.
#include "policies/api/gain.hpp"

#include "policies/api/context.hpp"

namespace sofof::policies {

double gain(const provider_view& provider, const world::cycle_cost& on_board,
            const service_needs& needs, const cost_weights& weights) {
  auto there = provider.cost;
  const auto& usual = provider.link.median;
  there.time_s =
      usual ? to_seconds(*usual) : there.time_s + provider.computing_s;
  const auto reference_j = on_board.energy_j;
  return weighed(on_board, 0, needs, reference_j, weights)
         - weighed(there, provider.link.late, needs, reference_j, weights);
}

} // namespace sofof::policies
