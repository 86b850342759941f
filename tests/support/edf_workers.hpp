// Equal workers that take the most urgent job, and finish what they began.
#pragma once

#include "base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace sofof::test {

struct timed_job {
  time_point release;
  time_point deadline;
  duration work;
  std::size_t group = 0; ///< Of sessions.
};

/// @param jobs     By release.
/// @param workers  At least 1.
/// @returns when each is done.
inline std::vector<time_point>
finish_by_deadlines(std::span<const timed_job> jobs, std::size_t workers) {
  using entry = std::pair<time_point, std::size_t>; // deadline, job
  std::priority_queue<entry, std::vector<entry>, std::greater<>> waiting;
  std::vector<time_point> free_at(workers, time_point::min()),
      done(jobs.size());
  auto now = time_point::min();
  std::size_t next = 0;
  while (next < jobs.size() || !waiting.empty()) {
    const auto worker = std::ranges::min_element(free_at);
    now = std::max(now, *worker);
    if (waiting.empty())
      now = std::max(now, jobs[next].release);
    for (; next < jobs.size() && jobs[next].release <= now; ++next)
      waiting.emplace(jobs[next].deadline, next);
    const auto job = waiting.top().second;
    waiting.pop();
    *worker = done[job] = now + jobs[job].work;
  }
  return done;
}

} // namespace sofof::test
