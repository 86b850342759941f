// Keeps what happened: hands the records of all actors to one sink.
#include "actors/runtime/recorder.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

namespace {

messages::recorder_actor::behavior_type
recorder(messages::recorder_actor::pointer,
         const std::shared_ptr<messages::record_sink>& sink) {
  return {[sink](const messages::record& x) { sink->on_record(x); }};
}

} // namespace

messages::recorder_actor
spawn_recorder(caf::actor_system& sys,
               std::shared_ptr<messages::record_sink> sink) {
  return sys.spawn(recorder, std::move(sink));
}

void send_record(const messages::recorder_actor& recorder,
                 messages::record what) {
  caf::anon_send(recorder, std::move(what));
}

} // namespace sofof::actors
