// A server queue that several threads share.
#pragma once

#include "channel/server_queue.hpp"

#include <mutex>

namespace sofof::channel {

/// The edge server's workers, or a radio cell's airtime, of all who use them:
/// safe to share between threads.
class shared_server_queue {
public:
  /// @param workers  At least 1.
  /// @throws std::invalid_argument  for none.
  explicit shared_server_queue(unsigned workers) : queue_{workers} {}

  /// As `server_queue::finish`.
  time_point finish(time_point now, duration work) {
    const std::lock_guard lock{mutex_};
    return queue_.finish(now, work);
  }

private:
  std::mutex mutex_;
  server_queue queue_;
};

} // namespace sofof::channel
