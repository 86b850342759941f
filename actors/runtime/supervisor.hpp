// Notices when an actor that must live as long as the run has died.
#pragma once

#include <caf/actor.hpp>
#include <caf/actor_system.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

/// @param watched  Actors and what they are called.
/// @param on_loss  Called with a sentence for each one that ends otherwise
///                 than by user_shutdown; from the supervisor's thread.
caf::actor
spawn_supervisor(caf::actor_system& sys,
                 std::vector<std::pair<caf::actor, std::string>> watched,
                 std::function<void(const std::string&)> on_loss);

/// Has a supervisor watch somebody who was spawned after it.
void watch_as_well(const caf::actor& supervisor, const caf::actor& actor,
                   const std::string& name);

} // namespace sofof::actors
