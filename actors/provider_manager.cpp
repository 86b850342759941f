// Service management at the provider: one accepted service, from data in to
// results out.
#include "actors/service_manager.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

struct manager_state {
  static inline const char* name = "provider_manager";
  provider_manager_actor::stateful_pointer<manager_state> self = nullptr;
  caf::actor_addr provider;
  instance_actor instance;
  requester_actor requester;
  bool fed = false;

  // A provider lives long, and does not forget by itself who watched it.
  ~manager_state() {
    if (self)
      self->demonitor(provider);
  }
};

provider_manager_actor::behavior_type
manager(provider_manager_actor::stateful_pointer<manager_state> self,
        instance_setup setup, requester_actor requester,
        const provider_actor& provider) {
  auto& state = self->state;
  state.self = self;
  state.provider = provider.address();
  setup.results = self;
  state.requester = std::move(requester);
  state.instance = spawn_instance(self->system(), std::move(setup));
  self->link_to(state.instance);
  self->monitor(provider);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->quit(down.reason); });
  self->send(state.instance, lifecycle_step::configure);
  return {
      [self](service_result& result) {
        self->send(self->state.requester, std::move(result));
      },
      [self](service_input& input) {
        auto& s = self->state;
        self->send(s.instance, std::move(input));
        if (!std::exchange(s.fed, true))
          self->send(s.instance, lifecycle_step::activate);
      },
      [self](const service_end&) {
        self->send(self->state.instance, lifecycle_step::deactivate);
        self->send(self->state.instance, lifecycle_step::shut_down);
        self->quit();
      },
  };
}

} // namespace

provider_manager_actor spawn_provider_manager(caf::actor_system& sys,
                                              instance_setup instance,
                                              requester_actor requester,
                                              const provider_actor& provider) {
  return sys.spawn(manager, std::move(instance), std::move(requester),
                   provider);
}

} // namespace sofof
