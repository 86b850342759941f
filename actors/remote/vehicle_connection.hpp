// A connection to vehicles on another host.
#pragma once

#include "actors/remote/provider_endpoint.hpp"
#include "actors/remote/requester_proxy.hpp"

#include <caf/actor_system.hpp>

#include <string>

namespace sofof {

/// What its endpoint takes from the peer, and what the provider sends: it is a
/// vehicle_outbox, too. This handle never leaves the process.
using vehicle_connection_actor = provider_endpoint_actor::extend<
    reacts_to<station_id::rep, service_offer>,
    reacts_to<service_response, std::vector<provider_manager_actor>>,
    reacts_to<service_result>,
    // Something that came by the connection was dropped for this reason.
    reacts_to<std::string>>;

/// Stands for all vehicles of one peer, as spawn_provider_endpoint says.
/// @param endpoint  Passes on what the peer sends; answers are sent in its
///                  name.
vehicle_connection_actor
spawn_vehicle_connection(caf::actor_system& sys, vehicle_connection_setup setup,
                         const provider_endpoint_actor& endpoint);

} // namespace sofof
