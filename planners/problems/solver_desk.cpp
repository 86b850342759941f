// A desk is set up when a thread plans for the first time.
#include "planners/problems/solver_desk.hpp"

#include <memory>

namespace sofof::planners {

solver_desk& solver_desk::here() {
  static thread_local const auto desk = std::make_unique<solver_desk>();
  return *desk;
}

} // namespace sofof::planners
