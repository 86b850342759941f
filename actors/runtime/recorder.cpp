// Keeps what happened: hands the records of all actors to one sink.
#include "actors/runtime/recorder.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

recorder_actor::behavior_type
recorder(recorder_actor::pointer, const std::shared_ptr<record_sink>& sink) {
  return {[sink](const record& x) { sink->on_record(x); }};
}

} // namespace

recorder_actor spawn_recorder(caf::actor_system& sys,
                              std::shared_ptr<record_sink> sink) {
  return sys.spawn(recorder, std::move(sink));
}

} // namespace sofof
