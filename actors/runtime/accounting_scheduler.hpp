// CAF's own scheduler, with a ledger of who took how much computing time.
#pragma once

#include "actors/runtime/cpu_clock.hpp"
#include "actors/runtime/cpu_ledger.hpp"
#include "actors/runtime/sharing_scheduler.hpp"

#include <caf/actor_clock.hpp>
#include <caf/actor_system.hpp>
#include <caf/local_actor.hpp>
#include <caf/resumable.hpp>
#include <caf/scheduler/coordinator.hpp>

namespace sofof::actors {

/// Work sharing, with a look at the thread's own clock before and after each
/// turn. There is one per worker, and one worker per thread.
class accounting_policy final : public sharing_policy {
public:
  struct coordinator_data : sharing_policy::coordinator_data {
    explicit coordinator_data(caf::scheduler::abstract_coordinator* of)
        : sharing_policy::coordinator_data{of}, ledger{[of] {
            return time_point{of->clock().now().time_since_epoch()};
          }} {}

    cpu_ledger ledger;
  };

  template <class Worker>
  void before_resume(Worker*, caf::resumable*) {
    began_ = thread_cpu_time();
  }

  template <class Worker>
  void after_resume(Worker* worker, caf::resumable* job) {
    const auto cpu = thread_cpu_time() - began_;
    if (const auto* actor = dynamic_cast<caf::local_actor*>(job))
      ledger_of(worker).add_turn(actor->id(), actor->name(), cpu);
  }

  template <class Worker>
  void after_completion(Worker* worker, caf::resumable* job) {
    if (const auto* actor = dynamic_cast<caf::local_actor*>(job))
      ledger_of(worker).close(actor->id());
  }

private:
  template <class Worker>
  static cpu_ledger& ledger_of(Worker* worker) {
    return worker->parent()->data().ledger;
  }

  duration began_{};
};

/// Install it with `config.load<accounting_scheduler>()`.
class accounting_scheduler final
    : public caf::scheduler::coordinator<accounting_policy> {
public:
  using coordinator::coordinator;

  static caf::actor_system::module* make(caf::actor_system& sys,
                                         caf::detail::type_list<>) {
    return new accounting_scheduler(sys);
  }
  static void add_module_options(caf::actor_system_config&) {}
};

} // namespace sofof::actors
