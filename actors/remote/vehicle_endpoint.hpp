// One connection to a provider, from its introduction on.
#pragma once

#include "actors/remote/provider_connection.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>
#include <string>

namespace sofof {

/// What connections tell the uplink that made them, whose handle never leaves
/// the process.
using connection_user = uplink_actor::extend<
    // The provider has let us in.
    reacts_to<peer_welcome, session_actor>,
    // It has not, for this reason; whether it will never do so.
    reacts_to<std::string, bool>>;

/// Introduces us at a gate. If it lets us in, passes on what its session says
/// and is whom that session hears; if not, tells why and ends. Ends with its
/// user, too.
uplink_actor spawn_connection(caf::actor_system& sys, const gate_actor& gate,
                              std::shared_ptr<const uplink_setup> setup,
                              const connection_user& user);

} // namespace sofof
