// One core that several functions share, each with a job at a time.
#pragma once

#include "base/core_order.hpp"
#include "base/time.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace sofof::channel {

/// Computes the most urgent job that it has, and interrupts it, at no cost, for
/// one that is more urgent. For one thread. Deterministic: of jobs that are
/// equally urgent, that of the function with the lower number.
class preemptive_core {
public:
  /// @param functions  They are numbered from 0 on: by fixed priorities the
  ///                   most urgent first.
  preemptive_core(core_order order, std::size_t functions)
      : order_{order}, jobs_(functions) {}

  /// Releases a job.
  /// @param function  It has none under way.
  /// @param now       Never earlier than in calls before.
  /// @param work      >= 0.
  /// @param due       By when it should be done, for `edf`.
  void begin(std::size_t function, time_point now, duration work,
             time_point due);

  /// @returns when the function's latest job is done: if that is later than
  /// now, unless more urgent jobs are released until then; it is never earlier.
  time_point done_at(std::size_t function, time_point now);

  /// @returns whether the function's latest job is not yet done.
  bool is_under_way(std::size_t function, time_point now);

private:
  struct job {
    bool is_under_way = false;
    duration left{};
    time_point due;
    time_point done; // if it is not under way
  };

  void compute_until(time_point now);
  bool is_before(std::size_t a, std::size_t b) const;

  core_order order_;
  std::vector<job> jobs_; // by function
  time_point now_ = time_point::min();
};

/// What one function has of the computer that it runs on.
struct core_seat {
  std::shared_ptr<preemptive_core> core; ///< Null: a core of its own.
  std::size_t number = 0;                ///< The function's, there.
};

} // namespace sofof::channel
