// What became of all octets that a radio cell was given in one direction.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "channel/link_direction.hpp"
#include "channel/time_rows.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <queue>
#include <string>
#include <string_view>
#include <utility>
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
  octet_count& operator+=(const octet_count& x);
};

/// What was sent; it has been delivered, was lost, or is under way.
struct octet_fates {
  octet_count sent;
  octet_count delivered;
  octet_count lost;
  octet_count under_way;

  octet_fates& operator+=(const octet_fates& x);
};

/// Of all messages for one thing.
struct octet_line {
  std::string what;            ///< What they are for.
  time_rows<octet_fates> rows; ///< By when they were sent, since the start.

  octet_fates together() const;
};

/// How many messages a link disturbed.
struct disturbed_count {
  std::uint64_t lost = 0;   ///< By chance.
  std::uint64_t outage = 0; ///< Lost, as nothing got through.
  std::uint64_t stall = 0;  ///< Delivered late, as a stall held them back.
  std::uint64_t slow = 0;   ///< Delivered late, as the network was slow.
  // Besides, of those and of others:
  std::uint64_t copied = 0;    ///< Delivered twice.
  std::uint64_t overtaken = 0; ///< Delivered late; later ones did not wait.

  void add(disturbance by);
  disturbed_count& operator+=(const disturbed_count& x);
  /// @returns what hit most of them; `none` for none.
  disturbance most() const;
};

/// Messages of or to one vehicle for one thing that were sent at one moment
/// and disturbed.
struct disturbed_line {
  duration at{}; ///< Since the start.
  station_id station = 0;
  std::string what;
  disturbed_count count;
};

/// A message that leaves.
struct sending {
  std::string_view what;  ///< What it is for: a service, or a kind of message.
  station_id station = 0; ///< The vehicle that sends or shall get it.
  std::size_t octets = 0; ///< On the air.
  time_point at;          ///< Not before the start.
  disturbance by = disturbance::none;
  bool is_overtaken = false;
  bool is_copy = false; ///< Of one that was sent before.

  bool is_disturbed() const {
    return by != disturbance::none || is_overtaken || is_copy;
  }
  /// @returns its copy; what disturbed it is counted once.
  sending copy() const {
    return {what, station, octets, at, disturbance::none, false, true};
  }
};

/// Counts messages when they are sent, and again when they are lost or their
/// time to arrive has come, whoever may be there to take them. Safe to share
/// between threads.
class octet_ledger {
public:
  /// @param start  Row 0 begins then.
  explicit octet_ledger(time_point start) : start_{start} {}

  /// A message leaves that will arrive.
  void send(const sending& x, time_point arrives);

  /// A message leaves that will not.
  void lose(const sending& x);

  /// @returns a line for all that was sent for one thing, in the order of the
  /// first of each, with rows of one length; what arrives after `now` is under
  /// way.
  /// @param now  Not earlier than in calls before.
  std::vector<octet_line> read(time_point now);

  /// Forgets what was disturbed before then, so that long runs need no more
  /// memory than short ones.
  /// @returns a line for each moment, vehicle and purpose of that, in this
  /// order.
  std::vector<disturbed_line> take_disturbed(time_point before);

private:
  struct arrival {
    time_point at;
    std::size_t line;
    duration sent; // since the start
    std::size_t octets;

    bool operator>(const arrival& other) const { return at > other.at; }
  };
  using who = std::pair<station_id, std::string>; // and for what

  octet_line& line_of(std::string_view what);
  octet_fates& count(const sending& x, octet_line& line);
  void deliver(time_point now);

  time_point start_;
  mutable std::mutex mutex_;
  std::vector<octet_line> lines_;
  std::map<std::pair<duration, who>, disturbed_count> disturbed_;
  std::priority_queue<arrival, std::vector<arrival>, std::greater<>> under_way_;
};

} // namespace sofof::channel
