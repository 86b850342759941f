// What a split of a chain of services would take at both ends.
#include "policies/api/split_energy.hpp"

#include <cassert>

namespace sofof::policies {

namespace {

/// @returns what a service takes in a second.
/// @param beside  Whether the one before runs at the same provider.
world::energy_use used_in_a_second(const service_rates& x, bool at_home,
                                   bool beside) {
  world::energy_use use;
  const auto own_s = x.period_s > 0 ? x.run_time_s / x.period_s : 0;
  if (at_home) {
    use.computing_s = own_s;
    return use;
  }
  use.resting_s = own_s;
  use.octets_up =
      x.inputs_per_s * (beside ? x.input_octets_beside : x.input_octets);
  use.octets_down = x.results_per_s * x.result_octets;
  use.framework_j = x.results_per_s * x.framework_j;
  use.served_s = x.results_per_s * x.served_s;
  return use;
}

} // namespace

world::energy_parts
predicted_power(std::span<const service_rates> chain,
                std::span<const service_place> places,
                const world::vehicle_power& vehicle,
                std::span<const world::server_power> servers) {
  assert(chain.size() == places.size());
  world::energy_parts sum;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const auto& place = places[k];
    assert(!place || *place < servers.size());
    const auto beside = place && k > 0 && places[k - 1] == place;
    const auto use = used_in_a_second(chain[k], !place, beside);
    sum += world::energy_of(use, vehicle,
                            place ? servers[*place] : world::server_power{});
  }
  return sum;
}

} // namespace sofof::policies
