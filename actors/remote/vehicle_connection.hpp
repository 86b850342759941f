// What a session does with what its peer says, and with what the provider says.
#pragma once

#include "actors/remote/provider_endpoint.hpp"
#include "actors/remote/requester_proxy.hpp"

#include <caf/actor_system.hpp>

#include <string>

namespace sofof {

/// A session, as the actors of this process see it; its handle never leaves it.
/// It is a session_mouth, too.
using session_core_actor = session_actor::extend<
    reacts_to<station_id, service_offer>,
    reacts_to<service_response, std::vector<provider_manager_actor>>,
    reacts_to<service_result>,
    // Something that came by the connection was dropped for this reason.
    reacts_to<std::string>>;

/// @param endpoint  Passes on what the peer says, and is whom the peer hears.
session_core_actor spawn_session_core(caf::actor_system& sys,
                                      session_setup setup,
                                      const session_actor& endpoint);

} // namespace sofof
