// Notices when an actor that must live as long as the run has died.
#include "actors/supervisor.hpp"

#include "messages/type_ids.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/exit_reason.hpp>
#include <fmt/format.h>

#include <map>

namespace sofof {

namespace {

caf::behavior
supervise(caf::event_based_actor* self,
          const std::vector<std::pair<caf::actor, std::string>>& watched,
          const std::function<void(const std::string&)>& on_loss) {
  std::map<caf::actor_addr, std::string> names;
  for (const auto& [actor, name] : watched) {
    names.emplace(actor.address(), name);
    self->monitor(actor);
  }
  self->set_down_handler(
      [on_loss, names = std::move(names)](const caf::down_msg& down) {
        if (down.reason != caf::exit_reason::user_shutdown)
          on_loss(fmt::format("{} has died: {}", names.at(down.source),
                              to_string(down.reason)));
      });
  return {[](tick_atom) {}}; // an actor that expects nothing would end
}

} // namespace

caf::actor
spawn_supervisor(caf::actor_system& sys,
                 std::vector<std::pair<caf::actor, std::string>> watched,
                 std::function<void(const std::string&)> on_loss) {
  return sys.spawn(supervise, std::move(watched), std::move(on_loss));
}

} // namespace sofof
