// Keeps what happened: hands the records of all actors to one sink.
#include "actors/runtime/recorder.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

recorder_actor::behavior_type
recorder(recorder_actor::pointer, const std::shared_ptr<record_sink>& sink) {
  return {
      [sink](const event_record& r) { sink->take(r); },
      [sink](const decision_record& r) { sink->take(r); },
      [sink](const cycle_record& r) { sink->take(r); },
      [sink](const episode_record& r) { sink->take(r); },
      [sink](const track_record& r) { sink->take(r); },
      [sink](const safety_record& r) { sink->take(r); },
      [sink](const collision_record& r) { sink->take(r); },
      [sink](const drive_record& r) { sink->take(r); },
      [sink](const plan_switch_record& r) { sink->take(r); },
      [sink](const air_record& r) { sink->take(r); },
  };
}

} // namespace

recorder_actor spawn_recorder(caf::actor_system& sys,
                              std::shared_ptr<record_sink> sink) {
  return sys.spawn(recorder, std::move(sink));
}

} // namespace sofof
