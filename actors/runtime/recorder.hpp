// Keeps what happened: hands the records of all actors to one sink.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>
#include <utility>

namespace sofof::actors {

/// @param sink  Used by this actor only, until it has quit.
messages::recorder_actor
spawn_recorder(caf::actor_system& sys,
               std::shared_ptr<messages::record_sink> sink);

/// Tells it from a thread that is no actor's what has happened.
void send_record(const messages::recorder_actor& recorder,
                 messages::record what);

/// Tells it from an actor what has happened.
template <class Self>
void send_record(Self* self, const messages::recorder_actor& recorder,
                 messages::record what) {
  self->send(recorder, std::move(what));
}

} // namespace sofof::actors
