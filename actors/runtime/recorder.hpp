// Keeps what happened: hands the records of all actors to one sink.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>

namespace sofof {

/// @param sink  Used by this actor only, until it has quit.
recorder_actor spawn_recorder(caf::actor_system& sys,
                              std::shared_ptr<record_sink> sink);

} // namespace sofof
