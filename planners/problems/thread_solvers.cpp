// They are made when a thread plans for the first time.
#include "planners/problems/thread_solvers.hpp"

#include <memory>

namespace sofof::planners {

thread_solvers& thread_solvers::here() {
  static thread_local const auto all = std::make_unique<thread_solvers>();
  return *all;
}

} // namespace sofof::planners
