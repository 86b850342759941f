// A queue before a few equal servers.
#pragma once

#include "base/time.hpp"

#include <mutex>
#include <vector>

namespace sofof::channel {

/// First-come-first-served servers: the edge server's workers, or the one
/// radio cell that all its vehicles share. Safe to share between threads.
class multi_server_queue {
public:
  /// @param workers  At least 1.
  /// @throws std::invalid_argument  for none.
  explicit multi_server_queue(unsigned workers);

  /// Queues a job; the worker that is free first takes it.
  /// @param now   When the job arrives; never earlier than in calls before
  ///              (an earlier one is treated as arriving with the last).
  /// @param work  >= 0.
  /// @returns when it will be done.
  time_point finish(time_point now, duration work);

private:
  std::mutex mutex_;
  time_point last_arrival_ = time_point::min();
  std::vector<time_point> free_at_; // one per worker
};

} // namespace sofof::channel
