// A scheduler of virtual time may have helpers for what takes long.
#pragma once

#include "base/job_pool.hpp"

#include <caf/actor_system.hpp>
#include <caf/scheduler/abstract_coordinator.hpp>

#include <memory>
#include <utility>

namespace sofof::actors {

/// Actors take their turns in one thread, one after the other; what they begin
/// is computed by others meanwhile.
class helped_scheduler {
public:
  virtual ~helped_scheduler() = default;

  /// @param pool  Null: cycles are computed when they start.
  void be_helped_by(std::shared_ptr<job_pool> pool) { pool_ = std::move(pool); }

  const std::shared_ptr<job_pool>& pool() const { return pool_; }

private:
  std::shared_ptr<job_pool> pool_;
};

/// @returns who helps in a system; null: nobody does.
inline std::shared_ptr<job_pool> pool_of(caf::actor_system& sys) {
  const auto* here = dynamic_cast<helped_scheduler*>(&sys.scheduler());
  return here ? here->pool() : nullptr;
}

} // namespace sofof::actors
