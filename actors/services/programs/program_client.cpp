// A clock that gives inputs.
#include "actors/services/programs/program_client.hpp"

#include "actors/runtime/time.hpp"
#include "actors/services/programs/program_octets.hpp"
#include "base/random_phase.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

namespace {

using program_client_impl =
    messages::client_actor::extend<messages::reacts_to<messages::tick_atom>>;

struct program_client_state {
  static inline const char* name = "program_client";

  program_client_impl::stateful_pointer<program_client_state> self;
  program_questions asks;
  std::shared_ptr<vehicle_view> view;
  station_id station;
  messages::requester_manager_actor manager;
  std::uint64_t asked = 0;

  void start() {
    const random_stream noise{0, "phases of programs"};
    const auto phase = random_phase(
        noise.part(station.value()).part(asks.service.view()), asks.period);
    send_at(self, self, now(self) + phase, messages::tick_atom_v);
  }

  void tick() {
    const auto t = now(self);
    send_at(self, self, t + asks.period, messages::tick_atom_v);
    if (!manager)
      return;
    auto octets = asks.from->next(*view, station, asked);
    if (octets.empty())
      return;
    ++asked;
    self->send(manager,
               messages::service_input{.session = {},
                                       .at = t,
                                       .what = messages::payload::of(
                                           program_octets{std::move(octets)})});
  }

  void on_result(const messages::service_result& result) const {
    if (const auto octets = result.what.as<program_octets>())
      view->keep_result(asks.service.view(), octets->octets);
  }
};

program_client_impl::behavior_type
program_client(program_client_impl::stateful_pointer<program_client_state> self,
               program_questions asks, std::shared_ptr<vehicle_view> view,
               station_id station) {
  auto& state = self->state;
  state.self = self;
  state.asks = std::move(asks);
  state.view = std::move(view);
  state.station = station;
  state.start();
  return {
      [self](const messages::service_result& result) {
        self->state.on_result(result);
      },
      [](const messages::source_change&) {},
      [self](const messages::requester_manager_actor& manager) {
        self->state.manager = manager;
      },
      [self](messages::tick_atom) { self->state.tick(); },
  };
}

} // namespace

messages::client_actor spawn_program_client(const client_place& where,
                                            program_questions asks) {
  return where.system.spawn(program_client, std::move(asks), where.view,
                            where.station);
}

} // namespace sofof::actors
