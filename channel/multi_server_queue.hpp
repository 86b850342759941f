// A queue before a few equal servers that several threads share.
#pragma once

#include "channel/server_queue.hpp"

#include <mutex>

namespace sofof::channel {

/// A server queue that is safe to share between threads.
class multi_server_queue {
public:
  /// As of a server queue.
  explicit multi_server_queue(unsigned workers) : queue_{workers} {}

  /// Likewise.
  time_point finish(time_point now, duration work) {
    const std::lock_guard lock{mutex_};
    return queue_.finish(now, work);
  }

private:
  std::mutex mutex_;
  server_queue queue_;
};

} // namespace sofof::channel
