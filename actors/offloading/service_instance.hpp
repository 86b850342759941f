// A service instance: the actor in which one function runs.
#pragma once

#include "messages/type_ids.hpp"
#include "offloading/service_cycle.hpp"

#include <caf/actor_system.hpp>

namespace sofof::actors {

/// What runs, and for whom.
struct instance_setup {
  offloading::cycle_setup cycle;
  messages::result_actor results; ///< Gets the result when the cycle is done.
};

/// Runs by the rules of offloading/service_cycle. Quits when finalized. One
/// whose function blocks has a thread of its own where time is real.
messages::instance_actor spawn_instance(caf::actor_system& sys,
                                        instance_setup setup);

} // namespace sofof::actors
