// CAF's scheduler with one queue for all threads.
#pragma once

#include <caf/actor_system.hpp>
#include <caf/policy/work_sharing.hpp>
#include <caf/resumable.hpp>
#include <caf/scheduler/coordinator.hpp>

#include <mutex>

namespace sofof::actors {

/// First come, first served. A thread that has nothing to do sleeps; it is
/// woken for what comes from outside, and for what a thread at work leaves
/// beside the one actor that it will see to itself after its turn. So an actor
/// that tells another one something, and that one a third, keeps one thread
/// busy.
class sharing_policy : public caf::policy::work_sharing {
public:
  template <class Worker>
  void internal_enqueue(Worker* worker, caf::resumable* job) {
    auto& shared = worker->parent()->data();
    const std::lock_guard lock{shared.lock};
    shared.queue.push_back(job);
    if (shared.queue.size() > 1)
      shared.cv.notify_one();
  }

  template <class Worker>
  void resume_job_later(Worker* worker, caf::resumable* job) {
    internal_enqueue(worker, job);
  }
};

/// Install it with `config.load<sharing_scheduler>()`.
class sharing_scheduler final
    : public caf::scheduler::coordinator<sharing_policy> {
public:
  using coordinator::coordinator;

  static caf::actor_system::module* make(caf::actor_system& sys,
                                         caf::detail::type_list<>) {
    return new sharing_scheduler(sys);
  }
  static void add_module_options(caf::actor_system_config&) {}
};

} // namespace sofof::actors
