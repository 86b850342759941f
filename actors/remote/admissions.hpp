// Who has been let in.
#pragma once

#include "actors/remote/acceptor.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>

namespace sofof::actors {

/// Knows all connections. Its handle never leaves the process.
using admissions_actor = caf::typed_actor<
    // A peer has proved who it is: it gets an endpoint, or an error that says
    // why not.
    caf::result<messages::peer_welcome, messages::provider_endpoint_actor>(
        messages::admission),
    // A peer was refused for this reason.
    messages::reacts_to<std::string>,
    // This handshake has opened; it is closed protocol::handshake_timeout
    // later.
    messages::reacts_to<messages::handshake_actor>>;

/// Gives each peer an endpoint of its own. One that comes in again with a
/// station takes the place of the endpoint of its name that spoke for it; a
/// name has a limit of them, so that it does not keep others out. Ends with the
/// provider.
admissions_actor spawn_admissions(caf::actor_system& sys,
                                  std::shared_ptr<const acceptor_setup> setup);

} // namespace sofof::actors
