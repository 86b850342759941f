// Back-pressure for values of which only the latest counts.
#pragma once

#include "base/time.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace sofof::network {

/// Streams of values to a peer that acknowledges each: per stream at most one
/// value is on its way and one waits, the latest. Memory is bounded however
/// long the peer stalls, and the last value of a stream gets through. Should an
/// acknowledgement get lost, the stream goes on with the first value that is
/// offered after a while.
/// @tparam Key  What names a stream; ordered by <.
template <class Key, class Value>
class conflating_queue {
public:
  /// @param most_streams  How many streams may wait for their peer at a time.
  /// @param patience      So long an acknowledgement may take.
  conflating_queue(std::size_t most_streams, duration patience)
      : most_streams_{most_streams}, patience_{patience} {}

  /// Takes the stream's credit if nothing of it is on its way; keeps the value
  /// until then otherwise, in place of one that waits. A stream beyond the
  /// most loses its value.
  /// @returns the value if it is to be sent now.
  std::optional<Value> offer(const Key& key, Value value, time_point now) {
    const auto found = streams_.find(key);
    if (found == streams_.end()) {
      if (streams_.size() >= most_streams_)
        return std::nullopt;
      streams_.emplace(key, stream{now, {}});
      return value;
    }
    auto& waits = found->second;
    if (now - waits.since >= patience_) {
      waits = {now, {}};
      return value;
    }
    waits.latest = std::move(value);
    return std::nullopt;
  }

  /// Gives a stream its credit back. Nothing happens if it is not out.
  /// @returns the value that waited, to be sent now; it takes the credit again.
  std::optional<Value> acknowledge(const Key& key, time_point now) {
    const auto found = streams_.find(key);
    if (found == streams_.end())
      return std::nullopt;
    auto next = std::exchange(found->second.latest, std::nullopt);
    found->second.since = now;
    if (!next)
      streams_.erase(found);
    return next;
  }

  /// Ends a stream: what waits is not sent, and the key has its credit again.
  void forget(const Key& key) { streams_.erase(key); }

  /// Ends all streams, e.g. when the connection is lost.
  void clear() { streams_.clear(); }

  /// @returns the number of streams whose credit is out.
  std::size_t size() const { return streams_.size(); }

private:
  /// One whose credit is out; one with credit needs no memory.
  struct stream {
    time_point since;            ///< When the value on its way was sent.
    std::optional<Value> latest; ///< Of those that wait.
  };

  std::size_t most_streams_;
  duration patience_;
  std::map<Key, stream> streams_;
};

} // namespace sofof::network
