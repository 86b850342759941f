// Notices when an actor that must live as long as the run has died.
#pragma once

#include <caf/actor.hpp>
#include <caf/actor_system.hpp>

#include <functional>
#include <string>

namespace sofof::actors {

/// @param on_loss  Called with a sentence for each one that ends otherwise
///                 than by user_shutdown; from the supervisor's thread.
caf::actor spawn_supervisor(caf::actor_system& sys,
                            std::function<void(const std::string&)> on_loss);

/// Has a supervisor watch an actor, dead or alive.
/// @param name  What it is called.
void watch(const caf::actor& supervisor, const caf::actor& actor,
           const std::string& name);

} // namespace sofof::actors
