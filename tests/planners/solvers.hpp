// Solvers on the heap; their workspaces are too large for a stack.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

#include <memory>

namespace sofof::test {

inline std::unique_ptr<planners::path_ocp> path_solver() {
  return std::make_unique<planners::path_ocp>();
}
inline std::unique_ptr<planners::velocity_ocp> speed_solver() {
  return std::make_unique<planners::velocity_ocp>();
}

} // namespace sofof::test
