// Virtual time: a deterministic discrete-event scheduler for CAF 0.18.
#pragma once

#include "actors/runtime/helped_scheduler.hpp"
#include "base/time.hpp"

#include <caf/action.hpp>
#include <caf/actor_clock.hpp>
#include <caf/disposable.hpp>
#include <caf/execution_unit.hpp>
#include <caf/resumable.hpp>
#include <caf/scheduler/abstract_coordinator.hpp>

#include <cassert>
#include <cstdint>
#include <deque>
#include <vector>

namespace sofof::actors {

/// A clock that moves only when told to; entries of the same time fire in the
/// order in which they were made.
class des_clock final : public caf::actor_clock {
public:
  time_point now() const noexcept override { return now_; }

  caf::disposable schedule_periodically(time_point first, caf::action what,
                                        duration_type period) override;

  bool empty() const { return heap_.empty(); }

  /// @returns the time of the next entry. Precondition: not empty.
  time_point next() const {
    assert(!empty());
    return heap_.front().at;
  }

  /// Runs the next entry and moves the time to it; a cancelled one does not
  /// move time. Precondition: not empty.
  void fire_next();

  /// Moves the time forward, never back.
  void advance_to(time_point t);

  void clear() { heap_.clear(); }

private:
  struct entry {
    time_point at;
    std::uint64_t number;
    caf::action what;
    duration_type period;
  };
  static bool later(const entry& a, const entry& b);

  std::vector<entry> heap_;
  std::uint64_t made_ = 0;
  time_point now_{};
};

/// One thread, a first-come-first-served run queue, one message per turn.
/// Install it with `config.load<des_scheduler>()`. Nothing detached or
/// blocking may live in its system, and only one thread may touch it.
class des_scheduler final : public caf::scheduler::abstract_coordinator,
                            public helped_scheduler {
public:
  explicit des_scheduler(caf::actor_system& sys);

  static caf::actor_system::module* make(caf::actor_system& sys,
                                         caf::detail::type_list<>);
  static void add_module_options(caf::actor_system_config&) {}

  des_clock& clock() noexcept override { return clock_; }
  bool detaches_utility_actors() const override { return false; }
  void enqueue(caf::resumable* job) override { jobs_.push_back(job); }

  /// Handles messages until none is left at the present time.
  void run_ready();

  /// Runs everything up to and including `end`, which then is the time.
  void run_until(sofof::time_point end);

protected:
  void start() override;
  void stop() override;

private:
  class worker final : public caf::execution_unit {
  public:
    explicit worker(des_scheduler* parent);
    void exec_later(caf::resumable* job) override;

  private:
    des_scheduler* parent_;
  };

  std::deque<caf::resumable*> jobs_;
  des_clock clock_;
  worker worker_;
};

} // namespace sofof::actors
