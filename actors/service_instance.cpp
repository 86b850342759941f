// A service instance: one function with a life cycle, run period by period.
#include "actors/service_instance.hpp"

#include "actors/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

// Besides its interface: the own timer, with the epoch it was set in.
using instance_impl = instance_actor::extend<takes<tick_atom, std::uint64_t>>;

struct instance_state {
  static inline const char* name = "service_instance";

  instance_impl::stateful_pointer<instance_state> self;
  instance_setup setup;
  lifecycle_state life = lifecycle_state::unconfigured;
  service_input newest;
  std::uint64_t epoch = 0;

  void take(lifecycle_step step) {
    const auto next = after(life, step);
    if (!next)
      return;
    life = *next;
    ++epoch;
    if (life == lifecycle_state::active && setup.keeps_phase)
      await_next();
    else if (life == lifecycle_state::active)
      run_cycle();
    else if (life == lifecycle_state::finalized)
      self->quit();
  }

  void tick(std::uint64_t set_in) {
    if (set_in == epoch)
      run_cycle();
  }

  void await_next() {
    send_at(self, self, next_on_grid(now(self), setup.phase, setup.period),
            tick_atom_v, epoch);
  }

  void run_cycle() {
    await_next();
    const auto t = now(self);
    if (newest.what.type().empty())
      return;
    auto result = setup.function->run(t, newest);
    if (result.what.type().empty())
      return;
    const auto cycle = static_cast<std::uint64_t>(
        (t.time_since_epoch() - setup.phase + setup.period) / setup.period);
    send_at(self, setup.results, setup.finish(t, cycle),
            service_result{setup.running, cycle, t, std::move(result.what),
                           std::move(result.about)});
  }
};

instance_impl::behavior_type
instance(instance_impl::stateful_pointer<instance_state> self,
         instance_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  return {
      [self](lifecycle_step step) { self->state.take(step); },
      [self](service_input& input) { self->state.newest = std::move(input); },
      [self](tick_atom, std::uint64_t epoch) { self->state.tick(epoch); },
  };
}

} // namespace

instance_actor spawn_instance(caf::actor_system& sys, instance_setup setup) {
  return sys.spawn(instance, std::move(setup));
}

} // namespace sofof
