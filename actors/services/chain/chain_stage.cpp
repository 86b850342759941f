// What stands between two services of a chain in a vehicle.
#include "actors/services/chain/chain_stage.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

namespace {

struct chain_stage_state {
  static inline const char* name = "chain_stage";

  messages::chain_stage_actor::pointer self = nullptr;
  messages::recorder_actor recorder;
  station_id station = 0;
  onward make;
  messages::requester_manager_actor service; // whose client it is
  messages::input_actor next;
  messages::payload newest; // input

  void on_input(const messages::service_input& input) {
    newest = input.what;
    if (service)
      self->send(service, input);
  }

  void on_result(const messages::service_result& result) {
    if (!next || newest.empty())
      return;
    auto what = make(newest, result);
    if (what.empty())
      return;
    const auto t = now(self);
    send_record(self, recorder,
                messages::stage_record{station, result.session.service,
                                       result.session.provider, t,
                                       result.timing});
    self->send(next, messages::service_input{{}, t, std::move(what)});
  }
};

messages::chain_stage_actor::behavior_type chain_stage(
    messages::chain_stage_actor::stateful_pointer<chain_stage_state> self,
    const messages::vehicle_actor& vehicle, std::uint32_t place,
    messages::recorder_actor recorder, station_id station, onward make) {
  self->state.self = self;
  self->state.recorder = std::move(recorder);
  self->state.station = station;
  self->state.make = std::move(make);
  self->send(vehicle, place, messages::chain_stage_actor{self});
  return {
      [self](const messages::service_result& x) { self->state.on_result(x); },
      [](const messages::source_change&) {},
      [self](const messages::requester_manager_actor& service) {
        self->state.service = service;
      },
      [self](const messages::service_input& x) { self->state.on_input(x); },
      [self](const messages::input_actor& next) { self->state.next = next; },
  };
}

} // namespace

messages::client_actor spawn_chain_stage(const client_place& where,
                                         onward make) {
  return where.system.spawn(chain_stage, where.vehicle, where.place,
                            where.recorder, where.station, std::move(make));
}

} // namespace sofof::actors
