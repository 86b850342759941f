// Where others reach a worker.
#pragma once

#include "actors/remote/workbench.hpp"

namespace sofof {

/// Gives everybody who speaks the same language a workbench of his own, which
/// asks for the rest. All that a worker's process publishes.
gate_actor spawn_worker_gate(caf::actor_system& sys, workbench_setup setup);

} // namespace sofof
