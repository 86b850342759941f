// Service management at the provider: one accepted service, from data in to
// results out.
#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/record_on_air.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

namespace {

using provider_manager_impl = messages::provider_manager_actor::extend<
    // Has the first input come by now?
    messages::reacts_to<messages::tick_atom>>;

struct manager_state {
  static inline const char* name = "provider_manager";
  provider_manager_impl::stateful_pointer<manager_state> self = nullptr;
  caf::actor_addr provider;
  messages::instance_actor instance;
  messages::requester_actor requester;
  messages::recorder_actor recorder;
  bool fed = false;

  // A provider lives long, and does not forget by itself who watched it.
  ~manager_state() {
    if (self)
      self->demonitor(provider);
  }

  void feed(messages::service_input& input) {
    self->send(instance, std::move(input));
    if (!std::exchange(fed, true))
      self->send(instance, messages::lifecycle_step::activate);
  }

  // The response was lost on its way, or the vehicle has changed its mind.
  void check() {
    if (!fed)
      self->quit(caf::exit_reason::user_shutdown);
  }

  void end() {
    self->send(instance, messages::lifecycle_step::deactivate);
    self->send(instance, messages::lifecycle_step::shut_down);
    self->quit();
  }
};

provider_manager_impl::behavior_type
manager(provider_manager_impl::stateful_pointer<manager_state> self,
        provider_manager_setup setup) {
  auto& state = self->state;
  state.self = self;
  state.provider = setup.provider.address();
  state.requester = std::move(setup.requester);
  state.recorder = std::move(setup.recorder);
  state.instance =
      spawn_instance(self->system(), {std::move(setup.cycle), self});
  self->link_to(state.instance);
  self->monitor(setup.provider);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->quit(down.reason); });
  self->send(state.instance, messages::lifecycle_step::configure);
  send_after(self, self, protocol::start_timeout, messages::tick_atom_v);
  return {
      [self](messages::service_result& result) {
        record_on_air(self, self->state.recorder, result.what);
        self->send(self->state.requester, std::move(result));
      },
      [self](messages::service_input& input) { self->state.feed(input); },
      [self](const messages::service_end&) { self->state.end(); },
      [self](messages::tick_atom) { self->state.check(); },
  };
}

} // namespace

messages::provider_manager_actor
spawn_provider_manager(caf::actor_system& sys, provider_manager_setup setup) {
  return sys.spawn(manager, std::move(setup));
}

} // namespace sofof::actors
