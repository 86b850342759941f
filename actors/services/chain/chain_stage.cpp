// What stands between two services of a chain in a vehicle.
#include "actors/services/chain/chain_stage.hpp"

#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

namespace {

struct chain_stage_state {
  static inline const char* name = "chain_stage";

  messages::chain_stage_actor::pointer self = nullptr;
  onward make;
  messages::requester_manager_actor service; // whose client it is
  messages::input_actor next;
  messages::payload newest; // input
  bool is_warm = false;
  bool at_once = false; // what the next result becomes begins a cycle

  // What its function had ready is the first of its results now.
  void on_source(const messages::source_change& change) {
    at_once = at_once || (is_warm && !change.remote);
  }

  void on_input(const messages::service_input& input) {
    newest = input.what;
    at_once = at_once || input.at_once;
    if (service)
      self->send(service, input);
  }

  void on_result(const messages::service_result& result) {
    if (!next || newest.empty())
      return;
    auto what = make(newest, result);
    if (what.empty())
      return;
    messages::service_input input{{}, now(self), std::move(what)};
    input.at_once = std::exchange(at_once, false);
    self->send(next, std::move(input));
  }
};

messages::chain_stage_actor::behavior_type chain_stage(
    messages::chain_stage_actor::stateful_pointer<chain_stage_state> self,
    const messages::vehicle_actor& vehicle, std::uint32_t place, onward make,
    bool is_warm) {
  self->state.self = self;
  self->state.is_warm = is_warm;
  self->state.make = std::move(make);
  self->send(vehicle, place, messages::chain_stage_actor{self});
  return {
      [self](const messages::service_result& x) { self->state.on_result(x); },
      [self](const messages::source_change& x) { self->state.on_source(x); },
      [self](const messages::requester_manager_actor& service) {
        self->state.service = service;
      },
      [self](const messages::service_input& x) { self->state.on_input(x); },
      [self](const messages::input_actor& next) { self->state.next = next; },
  };
}

} // namespace

messages::client_actor spawn_chain_stage(const client_place& where, onward make,
                                         bool is_warm) {
  return where.system.spawn(chain_stage, where.vehicle, where.place,
                            std::move(make), is_warm);
}

} // namespace sofof::actors
