// The solvers of a thread.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

namespace sofof::planners {

/// 350 kB that all planners of a thread use, one after the other: what a
/// planner goes on from it keeps itself, as a `kept_plan`.
struct thread_solvers {
  path_ocp path;
  velocity_ocp velocity;

  /// @returns those of this thread.
  static thread_solvers& here();
};

} // namespace sofof::planners
