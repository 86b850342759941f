// The solvers of a thread.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

namespace sofof::planners {

/// 350 kB that planners share, one after the other: what they go on from
/// they keep themselves, as a `kept_plan`.
struct solver_desk {
  path_ocp path;
  velocity_ocp velocity;

  /// @returns that of this thread.
  static solver_desk& here();
};

} // namespace sofof::planners
