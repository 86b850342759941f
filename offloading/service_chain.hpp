// Services of a vehicle that make a chain, and what they take together.
#pragma once

#include "offloading/service_state.hpp"

#include <span>
#include <vector>

namespace sofof::offloading {

/// @param all  The vehicle's services.
/// @returns the services of the chain that one of them is part of, the first of
/// it first; that one alone if it is in none.
std::vector<const service_state*> chain_of(std::span<const service_state> all,
                                           const service_state& one);

/// @returns the longest time from what the vehicle sees to the first result of
/// the chain that depends on it, with `one` at a provider and each other
/// service where it is, or is about to be: of a service at a provider
/// `worst_response`, of one in the vehicle `own_response`. What one of them
/// gives becomes the next one's input at once, so these add up.
/// duration::max(): nothing bounds it.
/// @param chain  As `chain_of` gives it.
duration worst_response_of(std::span<const service_state* const> chain,
                           const service_state& one);

/// @returns the longest response time under which the scene is safe, as the
/// services of the chain have found it: the least; none, 0, before one of them
/// has looked; nullopt: none does.
std::optional<duration>
safe_response_of(std::span<const service_state* const> chain, time_point now);

} // namespace sofof::offloading
