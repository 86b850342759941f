// What energy is reckoned from in a scenario.
#include "scenario/energy_terms.hpp"

#include "scenario/placement.hpp"
#include "world/vehicle/cycle_cost.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sofof::scenario {

namespace {

/// What a service costs a vehicle with this computer.
recording::service_cost cost_of(const actors::service_type& type,
                                const world::computer_options& computer) {
  const auto& cycle = type.options.compute;
  const auto on_board = world::on_board_cost(computer, cycle);
  return {on_board.energy_j, world::sending_cost(computer, cycle).energy_j,
          cycle.overhead_j, from_seconds(on_board.time_s), type.options.period};
}

/// @returns the services that work on each other's results, the first one
/// first; each other one alone.
std::vector<std::vector<std::string>> chains_of(const scenario_definition& s) {
  std::vector<std::vector<std::string>> all;
  const auto follower = [&s](std::string_view name) {
    const auto found = std::ranges::find_if(
        s.services, [name](const auto& x) { return x->follows() == name; });
    return found != s.services.end() ? found->get() : nullptr;
  };
  for (const auto& type : s.services) {
    if (place_in_chain(s, *type) > 0)
      continue; // it is in that of the one before
    auto& chain = all.emplace_back();
    for (const actors::service_type* at = type.get(); at;
         at = follower(at->name()))
      chain.emplace_back(at->name());
  }
  return all;
}

} // namespace

recording::energy_terms energy_terms_of(const scenario_definition& s,
                                        const process_share& here) {
  recording::energy_terms all;
  for (const auto& v : place_vehicles(s))
    if (here.drives(v.station)) {
      const auto& computer = s.fleets[v.fleet].compute;
      all.vehicles[v.station] = world::power_of(computer);
      for (const auto& type : s.services)
        all.costs[{v.station, std::string{type->name()}}] =
            cost_of(*type, computer);
    }
  for (std::size_t k = 0; k < s.providers.size(); ++k) {
    const auto compute = s.compute_of(k);
    all.servers[s.providers[k].name] = {compute.worker_w,
                                        compute.worker_idle_w};
  }
  all.chains = chains_of(s);
  return all;
}

} // namespace sofof::scenario
