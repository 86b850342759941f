// CAF's scheduler for one host of several, with a clock that may be off.
#pragma once

#include "actors/runtime/clock_error.hpp"
#include "actors/runtime/sharing_scheduler.hpp"

#include <caf/action.hpp>
#include <caf/actor_system.hpp>
#include <caf/actor_system_config.hpp>
#include <caf/detail/thread_safe_actor_clock.hpp>
#include <caf/disposable.hpp>
#include <caf/scheduler/coordinator.hpp>

#include <utility>

namespace sofof::actors {

/// Shows the time of another clock with an error, and leaves the timers to it.
/// It derives from CAF's clock for the type alone: no thread of its own starts.
class host_clock final : public caf::detail::thread_safe_actor_clock {
public:
  /// @param machine  Must outlive it.
  host_clock(caf::actor_clock& machine, const clock_error& error)
      : machine_{machine}, error_{error} {}

  time_point now() const noexcept override {
    return to_caf(error_.shown(to_ours(machine_.now())));
  }

  /// A period runs by the machine's clock; no actor here has one.
  caf::disposable schedule_periodically(time_point first, caf::action what,
                                        duration_type period) override {
    return machine_.schedule_periodically(to_caf(error_.meant(to_ours(first))),
                                          std::move(what), period);
  }

private:
  static sofof::time_point to_ours(time_point t) {
    return sofof::time_point{t.time_since_epoch()};
  }
  static time_point to_caf(sofof::time_point t) {
    return time_point{t.time_since_epoch()};
  }

  caf::actor_clock& machine_;
  clock_error error_;
};

/// The scheduler of `sharing_scheduler`; all actors of its system, and CAF's
/// own timeouts, go by a `host_clock`.
class host_scheduler final
    : public caf::scheduler::coordinator<sharing_policy> {
public:
  host_scheduler(caf::actor_system& system, const clock_error& error)
      : coordinator{system}, clock_{coordinator::clock(), error} {}

  caf::detail::thread_safe_actor_clock& clock() noexcept override {
    return clock_;
  }

  /// Makes the systems of a configuration have one.
  static void install(caf::actor_system_config& config,
                      const clock_error& error) {
    config.module_factories.push_back(
        [error](caf::actor_system& system) -> caf::actor_system::module* {
          return new host_scheduler{system, error};
        });
  }

private:
  host_clock clock_;
};

} // namespace sofof::actors
