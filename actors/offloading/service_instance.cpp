// A service instance: mailbox and timer; the rules are in
// offloading/service_cycle.
#include "actors/offloading/service_instance.hpp"

#include "actors/runtime/helped_scheduler.hpp"
#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

// Besides its interface: the cycle's timer with this number.
using instance_impl = messages::instance_actor::extend<
    messages::reacts_to<messages::tick_atom, std::uint64_t>>;

struct instance_state : offloading::cycle_port {
  static inline const char* name = "service_instance";

  instance_impl::stateful_pointer<instance_state> self;
  messages::result_actor results;
  std::optional<offloading::service_cycle> cycle;

  void on_step(messages::lifecycle_step step) {
    cycle->on_step(step, now(self));
    if (cycle->state() == messages::lifecycle_state::finalized)
      self->quit();
  }

  void wake_at(time_point t, std::uint64_t number) override {
    send_at(self, self, t, messages::tick_atom_v, number);
  }
  void deliver_at(time_point t, messages::service_result result) override {
    send_at(self, results, t, std::move(result));
  }
  void deliver_at(time_point t, offloading::coming_result result) override {
    send_made_at(self, results, t, [coming = std::move(result)]() mutable {
      return coming.take();
    });
  }
};

instance_impl::behavior_type
instance(instance_impl::stateful_pointer<instance_state> self,
         instance_setup setup) {
  self->state.self = self;
  self->state.results = std::move(setup.results);
  setup.cycle.pool = pool_of(self->system());
  self->state.cycle.emplace(std::move(setup.cycle), self->state);
  return {
      [self](messages::lifecycle_step step) { self->state.on_step(step); },
      [self](const messages::service_input& input) {
        self->state.cycle->on_input(input, now(self));
      },
      [self](messages::tick_atom, std::uint64_t number) {
        self->state.cycle->on_timer(number, now(self));
      },
  };
}

} // namespace

messages::instance_actor spawn_instance(caf::actor_system& sys,
                                        instance_setup setup) {
  const auto is_real = !dynamic_cast<helped_scheduler*>(&sys.scheduler());
  return is_real && setup.cycle.function->blocks()
             ? sys.spawn<caf::detached>(instance, std::move(setup))
             : sys.spawn(instance, std::move(setup));
}

} // namespace sofof::actors
