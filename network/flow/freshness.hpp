// Which messages of another host are too old, whatever its clock says.
#pragma once

#include "base/time.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

namespace sofof::network {

/// Knows of each sender how long its fastest message of late seemed to be under
/// way: by how much the own clock is ahead of the sender's, and the least
/// delay. What took longer than that by more than its time to live is too old.
class freshness {
public:
  /// @param most  Senders that are remembered; for one more all are forgotten.
  explicit freshness(std::size_t most) : most_{most} {}

  /// A message has come.
  /// @param seems   The time here less its sender's when it was made.
  /// @param ttl     How long it is of use.
  /// @returns whether it still is.
  bool is_fresh(std::uint64_t sender, duration seems, duration ttl,
                time_point now) {
    if (fastest_.size() >= most_ && !fastest_.contains(sender))
      fastest_.clear();
    auto& of =
        fastest_.try_emplace(sender, fastest{seems, seems, now}).first->second;
    if (now - of.since > memory) {
      of.before = of.lately;
      of.lately = seems;
      of.since = now;
    }
    of.lately = std::min(of.lately, seems);
    return seems - std::min(of.lately, of.before) <= ttl;
  }

private:
  /// Clocks drift apart meanwhile by less than messages are late.
  static constexpr duration memory = std::chrono::minutes{1};

  struct fastest {
    duration before, lately;
    time_point since; ///< What is lately.
  };

  std::size_t most_;
  std::map<std::uint64_t, fastest> fastest_;
};

} // namespace sofof::network
