// What stands between two services of a chain in a vehicle.
#include "actors/services/chain/chain_stage.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

// More than are on their way at once.
constexpr std::size_t most_inputs = 32;

struct stage_setup {
  messages::recorder_actor recorder;
  station_id station = 0;
  std::uint32_t place = 0;
  onward make;
  bool is_warm = false;
};

struct chain_stage_state {
  static inline const char* name = "chain_stage";

  messages::chain_stage_actor::pointer self = nullptr;
  stage_setup setup;
  messages::requester_manager_actor service; // whose client it is
  messages::input_actor next;
  messages::payload newest; // input
  // When the latest inputs were made, and sensed.
  std::deque<std::pair<time_point, time_point>> inputs;
  // The first result of this input, or of a later one, begins a cycle.
  std::optional<time_point> at_once_from;

  // What its function had ready is the first of its results now.
  void on_source(const messages::source_change& change) {
    if (setup.is_warm && !change.remote && !at_once_from)
      at_once_from = time_point::min();
  }

  // Results of older inputs do not use up the early cycle.
  void on_input(const messages::service_input& input) {
    newest = input.what;
    inputs.emplace_back(input.at, input.sensed.value_or(input.at));
    if (inputs.size() > most_inputs)
      inputs.pop_front();
    if (input.at_once)
      at_once_from = input.at;
    if (service)
      self->send(service, input);
  }

  // @returns the sensing instant of the input that a result was made of, or of
  // the oldest known input.
  time_point sensed(const messages::service_result& result) const {
    auto found = inputs.front();
    for (const auto& x : inputs)
      if (x.first <= result.timing.input_at)
        found = x;
    return std::min(found.second, result.timing.input_at);
  }

  void on_result(const messages::service_result& result) {
    if (!next || newest.empty())
      return;
    auto what = setup.make(newest, result);
    if (what.empty())
      return;
    const auto t = now(self);
    send_record(self, setup.recorder,
                messages::stage_record{setup.station, result.session.service,
                                       result.session.provider, t,
                                       result.timing});
    messages::service_input input{{}, t, std::move(what)};
    input.at_once = at_once_from && result.timing.input_at >= *at_once_from;
    if (input.at_once)
      at_once_from.reset();
    input.sensed = sensed(result);
    self->send(next, std::move(input));
  }
};

messages::chain_stage_actor::behavior_type chain_stage(
    messages::chain_stage_actor::stateful_pointer<chain_stage_state> self,
    const messages::vehicle_actor& vehicle, stage_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->send(vehicle, self->state.setup.place,
             messages::chain_stage_actor{self});
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
  return where.system.spawn(chain_stage, where.vehicle,
                            stage_setup{where.recorder, where.station,
                                        where.place, std::move(make), is_warm});
}

} // namespace sofof::actors
