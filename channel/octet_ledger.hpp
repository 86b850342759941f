// What became of all octets that a radio cell was given in one direction.
#pragma once

#include "base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <queue>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::channel {

/// Messages, and what they take on the air.
struct octet_count {
  std::uint64_t messages = 0;
  std::uint64_t octets = 0;

  void add(std::size_t size) {
    ++messages;
    octets += size;
  }
};

/// Of all messages for one thing.
struct octet_line {
  std::string what; ///< What they are for.
  octet_count sent;
  octet_count delivered;
  octet_count lost;
  octet_count under_way;
};

/// Counts messages when they are sent, and again when they are lost or their
/// time to arrive has come, whoever may be there to take them. Safe to share
/// between threads.
class octet_ledger {
public:
  /// A message leaves that will arrive.
  /// @param what  What it is for: a service, or a kind of message.
  void send(std::string_view what, std::size_t octets, time_point now,
            time_point arrives);

  /// A message leaves that will not.
  void lose(std::string_view what, std::size_t octets);

  /// @returns a line for all that was sent for one thing, in the order of the
  /// first of each; what arrives after `now` is under way.
  /// @param now  Not earlier than in calls before.
  std::vector<octet_line> read(time_point now);

private:
  struct arrival {
    time_point at;
    std::size_t line;
    std::size_t octets;

    bool operator>(const arrival& other) const { return at > other.at; }
  };

  octet_line& line_of(std::string_view what);
  void deliver(time_point now);

  std::mutex mutex_;
  std::vector<octet_line> lines_;
  std::priority_queue<arrival, std::vector<arrival>, std::greater<>> under_way_;
};

} // namespace sofof::channel
