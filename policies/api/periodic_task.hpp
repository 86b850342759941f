// A session that computes once a period, as a scheduler sees it.
#pragma once

#include "base/time.hpp"

#include <cassert>
#include <cstddef>
#include <span>

namespace sofof::policies {

/// How jobs compute longer than they should at most.
struct overrun_law {
  double probability = 0; ///< Of each job.
  double mean_s = 0;      ///< E[(computing time − C)+], s.
};

struct periodic_task {
  duration wcet{0};     ///< C: computing time at most, on one core, ≥ 0.
  duration period{1};   ///< T > 0.
  duration deadline{0}; ///< D: from a job's arrival to its result.
  duration jitter{0}; ///< J ≥ 0: a job may be released so long after arrival.
  duration offset{0}; ///< Arrival of the first job, for those with a phase.
  overrun_law overrun{}; ///< Of C; whoever does not know it says none.
};

/// @returns J of a session whose first cycle is run at once, and the others on
/// the grid (offloading/service_cycle.hpp): two may come together.
constexpr duration jitter_with_first_cycle(duration period) {
  return period - duration{1};
}

/// @returns J of a session whose cycles are called by inputs. Each is run
/// within two periods, as at most one more is run than the grid has by then:
/// three may come together.
constexpr duration jitter_of_calls(duration period) {
  return 2 * period - duration{1};
}

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
