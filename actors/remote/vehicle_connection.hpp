// A connection to vehicles on another host.
#pragma once

#include "actors/remote/provider_endpoint.hpp"
#include "actors/remote/requester_proxy.hpp"

#include <caf/actor_system.hpp>

#include <string>

namespace sofof::actors {

/// What its endpoint takes from the peer, and what the provider sends: it is a
/// vehicle_outbox, too. This handle never leaves the process.
using vehicle_connection_actor = messages::provider_endpoint_actor::extend<
    messages::reacts_to<station_id::rep, messages::service_offer>,
    messages::reacts_to<messages::service_response,
                        std::vector<messages::provider_manager_actor>>,
    messages::reacts_to<messages::session_digest>,
    messages::reacts_to<messages::service_result>,
    // Something that came by the connection was dropped for this reason.
    messages::reacts_to<std::string>>;

/// Stands for all vehicles of one peer, as spawn_provider_endpoint says.
/// @param endpoint  Passes on what the peer sends; answers are sent in its
///                  name.
vehicle_connection_actor
spawn_vehicle_connection(caf::actor_system& sys, vehicle_connection_setup setup,
                         const messages::provider_endpoint_actor& endpoint);

} // namespace sofof::actors
