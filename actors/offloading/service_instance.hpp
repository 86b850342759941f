// A service instance: one function with a life cycle, run period by period.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>

namespace sofof {

/// When and for whom an instance runs.
struct instance_setup {
  session_id running; ///< Stamped on every result.
  std::shared_ptr<service_function> function;
  duration period{};
  duration phase{}; ///< Cycles start at phase + k · period.
  /// @returns when the cycle that starts now will be done: a model of the
  /// computer in virtual time, the identity where time is real.
  std::function<time_point(time_point start, std::uint64_t cycle)> finish;
  result_actor results; ///< Gets the result when the cycle is done.
  /// Whether the first cycle waits for its phase too, and is not run at once.
  bool keeps_phase = false;
};

/// Begins unconfigured. Active, it runs a cycle at once and then on its grid
/// (or on its grid only), always from the newest input; without any input it
/// waits. On call it runs one cycle for each input, at once, but at most one
/// more than the grid has by then. Cycles are numbered by the grid, so that
/// their noise does not depend on when the service was started; after two in
/// one period they are one ahead. Quits when finalized.
instance_actor spawn_instance(caf::actor_system& sys, instance_setup setup);

} // namespace sofof
