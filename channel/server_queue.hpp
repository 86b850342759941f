// A queue before a few equal servers.
#pragma once

#include "base/time.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <vector>

namespace sofof::channel {

/// First-come-first-served servers, for one thread; `shared_server_queue` is
/// for several.
class server_queue {
public:
  /// @param workers  At least 1.
  /// @throws std::invalid_argument  for none.
  explicit server_queue(unsigned workers)
      : free_at_(workers, time_point::min()) {
    if (workers == 0)
      throw std::invalid_argument{"a queue needs at least one worker"};
  }

  /// Queues a job; the worker that is free first takes it.
  /// @param now   When the job arrives; never earlier than in calls before
  ///              (an earlier one is treated as arriving with the last).
  /// @param work  >= 0.
  /// @returns when it will be done.
  time_point finish(time_point now, duration work) {
    assert(work >= duration{0});
    last_arrival_ = std::max(last_arrival_, now);
    const auto first_free = std::ranges::min_element(free_at_);
    *first_free = std::max(*first_free, last_arrival_) + work;
    return *first_free;
  }

private:
  time_point last_arrival_ = time_point::min();
  std::vector<time_point> free_at_; // one per worker
};

} // namespace sofof::channel
