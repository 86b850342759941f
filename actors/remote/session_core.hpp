// What a session does with what its peer says, and with what the provider says.
#pragma once

#include "actors/remote/far_requester.hpp"
#include "actors/remote/session.hpp"

#include <caf/actor_system.hpp>

#include <string>

namespace sofof {

/// A session, as the actors of this process see it; its handle never leaves it.
/// It is a session_mouth, too.
using session_core_actor = session_actor::extend<
    takes<station_id, service_offer>,
    takes<service_response, std::vector<provider_manager_actor>>,
    takes<service_result>,
    // Something that came by the connection was dropped for this reason.
    takes<std::string>>;

/// @param endpoint  Passes on what the peer says, and is whom the peer hears.
session_core_actor spawn_session_core(caf::actor_system& sys,
                                      session_setup setup,
                                      const session_actor& endpoint);

} // namespace sofof
