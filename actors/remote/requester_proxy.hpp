// A requester on another host, as a provider sees it.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

namespace sofof {

/// What a session takes from the provider of its process, besides what comes
/// from the far end. Who ends a service is told by the message itself.
using session_mouth = caf::typed_actor<
    reacts_to<station_id, service_offer>,
    reacts_to<service_response, std::vector<provider_manager_actor>>,
    reacts_to<service_result>, reacts_to<service_end>>;

/// Hands everything to the session that the station belongs to. One per
/// station, for a provider knows requesters by their handles. Dies with the
/// session, so that the provider sees its peer lost.
requester_actor spawn_far_requester(caf::actor_system& sys, station_id station,
                                    const session_mouth& session);

} // namespace sofof
