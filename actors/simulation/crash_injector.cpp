// Ends an actor at a time, without goodbye.
#include "actors/simulation/crash_injector.hpp"

#include "actors/runtime/time.hpp"
#include "messages/type_ids.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/exit_reason.hpp>

#include <utility>

namespace sofof::actors {

namespace {

caf::behavior crash_injector(caf::event_based_actor* self,
                             const caf::actor& victim, duration after) {
  send_after(self, self, after, messages::tick_atom_v);
  self->monitor(victim);
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  return {[self, victim](messages::tick_atom) {
    self->send_exit(victim, caf::exit_reason::kill);
    self->quit();
  }};
}

} // namespace

caf::actor spawn_crash_injector(caf::actor_system& sys, caf::actor victim,
                                duration after) {
  return sys.spawn(crash_injector, std::move(victim), after);
}

} // namespace sofof::actors
