// Actors whose policy may be another program wait for its answers.
#pragma once

#include "actors/runtime/helped_scheduler.hpp"

#include <caf/actor_system.hpp>
#include <caf/spawn_options.hpp>

#include <utility>

namespace sofof::actors {

/// Spawns an actor. Where time is real and a program decides in place of its
/// policy, it has a thread of its own: while it waits, others have theirs.
/// @param policy  Of `setup`, perhaps; not kept.
template <class Policy, class Behaviour, class Setup>
auto spawn_decider(caf::actor_system& sys, Policy& policy, Behaviour behaviour,
                   Setup&& setup) {
  const auto is_real = !dynamic_cast<helped_scheduler*>(&sys.scheduler());
  return is_real && policy.program()
             ? sys.spawn<caf::detached>(behaviour, std::forward<Setup>(setup))
             : sys.spawn(behaviour, std::forward<Setup>(setup));
}

} // namespace sofof::actors
