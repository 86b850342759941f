// What a split of a chain of services would take at both ends, from what each
// service costs: for decisions, before anything is sent.
#pragma once

#include "world/vehicle/energy_use.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace sofof::policies {

/// One service of a chain, by what was measured of it or is configured.
struct service_rates {
  double period_s = 0;   ///< At home, a result in each.
  double run_time_s = 0; ///< That the vehicle computes for one, on average.

  double results_per_s = 0; ///< Of a provider,
  double served_s = 0;      ///< computed there for so long each.
  double inputs_per_s = 0;  ///< That the vehicle sends.
  double input_octets = 0;  ///< On the air, of one of them,
  /// and of one where the service before runs at the same provider, so that
  /// what it found need not be sent.
  double input_octets_beside = 0;
  double result_octets = 0; ///< On the air.
  double framework_j = 0;   ///< Of the vehicle, for each result.
};

/// Where a service runs: at one of some providers, or, nullopt, at home.
using service_place = std::optional<std::size_t>;

/// @param chain    Its services in their order.
/// @param places   Of each of them.
/// @param servers  A worker of each provider; `places` are numbers of these.
/// @returns what that split takes in a second, J: the parts are powers, W.
/// Precondition: as many places as services.
world::energy_parts
predicted_power(std::span<const service_rates> chain,
                std::span<const service_place> places,
                const world::vehicle_power& vehicle,
                std::span<const world::server_power> servers);

} // namespace sofof::policies
