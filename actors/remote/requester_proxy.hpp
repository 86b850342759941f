// A requester on another host, as a provider sees it.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

namespace sofof::actors {

/// What a connection to vehicles takes from the provider of its process,
/// besides what comes from the far end. Who ends a service is told by the
/// message itself.
using vehicle_outbox = caf::typed_actor<
    messages::reacts_to<station_id::rep, messages::service_offer>,
    messages::reacts_to<messages::service_response,
                        std::vector<messages::provider_manager_actor>>,
    messages::reacts_to<messages::session_digest>,
    messages::reacts_to<messages::service_result>,
    messages::reacts_to<messages::service_end>>;

/// Hands everything to the connection that the station belongs to. One per
/// station, for a provider knows requesters by their handles. Dies with the
/// connection, so that the provider sees its peer lost.
messages::requester_actor spawn_requester_proxy(caf::actor_system& sys,
                                                station_id station,
                                                const vehicle_outbox& outbox);

} // namespace sofof::actors
