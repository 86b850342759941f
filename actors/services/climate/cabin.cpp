// The cabin of a car, as the client of climate control.
#include "actors/services/climate/cabin.hpp"

#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

namespace {

// The air in the car, warmed with whatever power came last.
using cabin_impl =
    messages::client_actor::extend<messages::reacts_to<messages::tick_atom>>;

struct cabin_actor_state {
  static inline const char* name = "cabin";

  cabin_impl::stateful_pointer<cabin_actor_state> self;
  climate_options options;
  duration period{};
  messages::requester_manager_actor manager;
  world::cabin_state air;
  double power_w = 0;

  void tick() {
    const auto t = now(self);
    send_at(self, self, t + period, messages::tick_atom_v);
    air = world::step(air, power_w, options.outside_c, options.cabin,
                      to_seconds(period));
    ask();
  }

  void ask() {
    if (manager)
      self->send(manager, messages::service_input{
                              {},
                              now(self),
                              messages::payload::of(climate_request{
                                  air.air_c, air.mass_c, options.outside_c,
                                  options.set_point_c})});
  }

  void on_result(const messages::service_result& result) {
    if (const auto answer = result.what.as<climate_power>())
      power_w = answer->power_w;
  }
};

cabin_impl::behavior_type
cabin(cabin_impl::stateful_pointer<cabin_actor_state> self,
      climate_options options, duration period) {
  auto& state = self->state;
  state.self = self;
  state.options = options;
  state.period = period;
  state.air = {options.outside_c, options.outside_c};
  self->send(self, messages::tick_atom_v);
  return {
      [self](const messages::service_result& result) {
        self->state.on_result(result);
      },
      [](const messages::source_change&) {},
      [self](const messages::requester_manager_actor& manager) {
        self->state.manager = manager;
        self->state.ask();
      },
      [self](messages::tick_atom) { self->state.tick(); },
  };
}

} // namespace

messages::client_actor spawn_cabin(caf::actor_system& sys,
                                   const climate_options& options,
                                   duration period) {
  return sys.spawn(cabin, options, period);
}

} // namespace sofof::actors
