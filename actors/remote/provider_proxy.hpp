// A provider on another host, as one vehicle sees it.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

namespace sofof::actors {

/// What a connection to a provider takes from the vehicles of its process,
/// besides what comes from the far end. Who ends a service is told by the
/// message itself.
using provider_outbox =
    caf::typed_actor<messages::reacts_to<station_id::rep, messages::its_pdu>,
                     messages::reacts_to<messages::service_request>,
                     messages::reacts_to<messages::service_input>,
                     messages::reacts_to<messages::service_end>>;

/// Stands where a link to a provider of the same process would. Hands what the
/// vehicle sends to the connection, and what comes from there to the vehicle.
/// Outlives connections.
messages::link_actor spawn_provider_proxy(caf::actor_system& sys,
                                          station_id station,
                                          const provider_outbox& outbox);

} // namespace sofof::actors
