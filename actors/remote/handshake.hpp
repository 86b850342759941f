// Where one peer introduces itself.
#pragma once

#include "actors/remote/admissions.hpp"

#include <caf/node_id.hpp>

#include <memory>
#include <string>

namespace sofof::actors {

/// Examines one hello, which only the process that asked for this handshake can
/// bring, and gets its peer an endpoint. Ends afterwards, with the admissions,
/// and when no hello comes in time.
/// @param process  Who asked.
/// @param nonce    What it was given to sign.
messages::handshake_actor
spawn_handshake(caf::actor_system& sys, const admissions_actor& admissions,
                std::shared_ptr<const acceptor_setup> setup,
                caf::node_id process, std::string nonce);

} // namespace sofof::actors
