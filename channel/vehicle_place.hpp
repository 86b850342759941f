// Where a vehicle is, for its links.
#pragma once

#include "base/geometry.hpp"

#include <mutex>
#include <optional>

namespace sofof::channel {

/// The vehicle tells it, its links ask, each in any thread.
class vehicle_place {
public:
  void tell(point at) {
    const std::lock_guard locked{mutex_};
    at_ = at;
  }

  /// @returns where it last was, m, east-north; nullopt before it is anywhere.
  std::optional<point> last() const {
    const std::lock_guard locked{mutex_};
    return at_;
  }

private:
  mutable std::mutex mutex_;
  std::optional<point> at_;
};

} // namespace sofof::channel
