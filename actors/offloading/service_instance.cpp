// A service instance: one function with a life cycle, run period by period.
#include "actors/offloading/service_instance.hpp"

#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>

namespace sofof {

namespace {

// Besides its interface: the own timer, with the epoch it was set in.
using instance_impl =
    instance_actor::extend<reacts_to<tick_atom, std::uint64_t>>;

struct instance_state {
  static inline const char* name = "service_instance";

  instance_impl::stateful_pointer<instance_state> self;
  instance_setup setup;
  lifecycle_state life = lifecycle_state::unconfigured;
  service_input newest;
  std::uint64_t epoch = 0; // of the one timer that counts
  bool has_timer = false;
  // Numbers after the latest cycle, and after the latest off the grid.
  std::uint64_t after_any = 0, after_call = 0;

  void take(lifecycle_step step) {
    const auto next = after(life, step);
    if (!next)
      return;
    life = *next;
    stop_timer();
    if (life == lifecycle_state::active)
      begin();
    else if (life == lifecycle_state::finalized)
      self->quit();
  }

  void feed(service_input& input) {
    newest = std::move(input);
    if (newest.on_call)
      stop_timer();
    if (life == lifecycle_state::active && !has_timer)
      begin();
  }

  void begin() {
    if (newest.on_call)
      run_cycle();
    else if (setup.keeps_phase)
      await_next();
    else
      tick(epoch);
  }

  void tick(std::uint64_t set_in) {
    if (set_in != epoch)
      return;
    await_next();
    run_cycle();
  }

  void stop_timer() {
    ++epoch;
    has_timer = false;
  }

  void await_next() {
    has_timer = true;
    send_at(self, self, next_on_grid(now(self), setup.phase, setup.period),
            tick_atom_v, epoch);
  }

  void run_cycle() {
    const auto t = now(self);
    if (newest.what.type().empty() || is_ahead(t))
      return;
    auto result = setup.function->run(t, newest);
    if (result.what.type().empty())
      return;
    const auto cycle = number_of(t);
    send_at(self, setup.results, setup.finish(t, cycle),
            service_result{setup.running, cycle, t, std::move(result.what),
                           std::move(result.about)});
  }

  std::uint64_t on_grid(time_point t) const {
    return static_cast<std::uint64_t>(
        (t.time_since_epoch() - setup.phase + setup.period) / setup.period);
  }

  // Who is called off the grid may run one cycle more than that has by then.
  std::uint64_t number_at(time_point t) const {
    return std::max(on_grid(t), newest.on_call ? after_any : after_call);
  }
  bool is_ahead(time_point t) const { return number_at(t) > on_grid(t) + 1; }

  std::uint64_t number_of(time_point t) {
    const auto cycle = number_at(t);
    after_any = cycle + 1;
    if (newest.on_call || cycle > on_grid(t))
      after_call = after_any;
    return cycle;
  }
};

instance_impl::behavior_type
instance(instance_impl::stateful_pointer<instance_state> self,
         instance_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  return {
      [self](lifecycle_step step) { self->state.take(step); },
      [self](service_input& input) { self->state.feed(input); },
      [self](tick_atom, std::uint64_t epoch) { self->state.tick(epoch); },
  };
}

} // namespace

instance_actor spawn_instance(caf::actor_system& sys, instance_setup setup) {
  return sys.spawn(instance, std::move(setup));
}

} // namespace sofof
