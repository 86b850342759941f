// Notices when an actor that must live as long as the run has died.
#include "actors/runtime/supervisor.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <fmt/format.h>

#include <map>

namespace sofof::actors {

namespace {

struct supervisor_state {
  static inline const char* name = "supervisor";

  std::map<caf::actor_addr, std::string> names;
};

using supervisor = caf::stateful_actor<supervisor_state>;

caf::behavior
supervise(supervisor* self,
          const std::function<void(const std::string&)>& on_loss) {
  self->set_down_handler([self, on_loss](const caf::down_msg& down) {
    if (down.reason != caf::exit_reason::user_shutdown)
      on_loss(fmt::format("{} has died: {}", self->state.names.at(down.source),
                          to_string(down.reason)));
  });
  return {[self](const caf::actor& actor, const std::string& name) {
    self->state.names.emplace(actor.address(), name);
    self->monitor(actor);
  }};
}

} // namespace

caf::actor spawn_supervisor(caf::actor_system& sys,
                            std::function<void(const std::string&)> on_loss) {
  return sys.spawn(supervise, std::move(on_loss));
}

void watch(const caf::actor& supervisor, const caf::actor& actor,
           const std::string& name) {
  caf::anon_send(supervisor, actor, name);
}

} // namespace sofof::actors
