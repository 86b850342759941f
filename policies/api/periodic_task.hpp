// A session that computes once a period, as a scheduler sees it.
#pragma once

#include "base/time.hpp"

#include <cassert>
#include <cstddef>
#include <span>

namespace sofof::policies {

struct periodic_task {
  duration wcet{0};     ///< C: computing time at most, on one core, ≥ 0.
  duration period{1};   ///< T > 0.
  duration deadline{0}; ///< D: from a job's arrival to its result.
  duration jitter{0}; ///< J ≥ 0: a job may be released so long after arrival.
  duration offset{0}; ///< Arrival of the first job, for those with a phase.
};

/// @returns Σ C/T: the share of one core that the tasks take.
double utilisation(std::span<const periodic_task> tasks);

/// @param computing_s  Of a cycle, mean, s, ≥ 0.
/// @param period       Of its cycles, > 0.
/// @param workers      Of the computer, > 0.
/// @returns the share of all workers' time that a session takes.
inline double worker_share(double computing_s, duration period,
                           std::size_t workers) {
  assert(computing_s >= 0 && period > duration{0} && workers > 0);
  return computing_s / to_seconds(period) / static_cast<double>(workers);
}

} // namespace sofof::policies
