// A server queue that several threads share.
#pragma once

#include "channel/load_meter.hpp"
#include "channel/server_queue.hpp"

#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

namespace sofof::channel {

/// The edge server's workers, or a radio cell's airtime, of all who use them:
/// safe to share between threads.
class shared_server_queue {
public:
  /// @param workers  At least 1.
  /// @param meter    Learns of every job, if there is one.
  /// @throws std::invalid_argument  for none.
  explicit shared_server_queue(unsigned workers,
                               std::shared_ptr<load_meter> meter = nullptr)
      : queue_{workers}, meter_{std::move(meter)} {}

  /// As `server_queue::finish`.
  /// @param what  What the work is for, as the meter is told.
  time_point finish(time_point now, duration work, std::string_view what = {}) {
    const std::lock_guard lock{mutex_};
    const auto done = queue_.finish(now, work);
    if (meter_)
      meter_->add(now, done - work - now, work, what);
    return done;
  }

private:
  std::mutex mutex_;
  server_queue queue_;
  std::shared_ptr<load_meter> meter_;
};

} // namespace sofof::channel
