// Back-pressure for values of which only the latest counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace sofof {

/// Streams of values to a peer that acknowledges each: per stream at most one
/// value is on its way and one waits, the latest. Memory is bounded however
/// long the peer stalls, and the last value of a stream always gets through.
/// @tparam Key  What names a stream; ordered by <.
template <class Key, class Value>
class latest_values {
public:
  /// @param most_streams  How many streams may wait for their peer at a time.
  explicit latest_values(std::size_t most_streams)
      : most_streams_{most_streams} {}

  /// Takes the stream's credit if nothing of it is on its way; keeps the value
  /// until then otherwise, in place of one that waits. A stream beyond the
  /// most loses its value.
  /// @returns the value if it is to be sent now.
  std::optional<Value> offer(const Key& key, Value value) {
    const auto stream = waiting_.find(key);
    if (stream == waiting_.end())
      return open(key, std::move(value));
    if (stream->second)
      ++replaced_;
    stream->second = std::move(value);
    return std::nullopt;
  }

  /// Gives a stream its credit back. Nothing happens if it is not out.
  /// @returns the value that waited, to be sent now; it takes the credit again.
  std::optional<Value> acknowledge(const Key& key) {
    const auto stream = waiting_.find(key);
    if (stream == waiting_.end())
      return std::nullopt;
    auto next = std::exchange(stream->second, std::nullopt);
    if (!next)
      waiting_.erase(stream);
    return next;
  }

  /// Ends a stream: what waits is not sent, and the key has its credit again.
  void forget(const Key& key) { waiting_.erase(key); }

  /// Ends all streams, e.g. when the connection is lost.
  void clear() { waiting_.clear(); }

  /// @returns the number of streams whose credit is out.
  std::size_t size() const { return waiting_.size(); }
  /// @returns how many values gave way to later ones.
  std::uint64_t replaced() const { return replaced_; }
  /// @returns how many values were lost because of too many streams.
  std::uint64_t dropped() const { return dropped_; }

private:
  std::optional<Value> open(const Key& key, Value value) {
    if (waiting_.size() >= most_streams_) {
      ++dropped_;
      return std::nullopt;
    }
    waiting_.emplace(key, std::nullopt);
    return value;
  }

  std::size_t most_streams_;
  // Streams whose credit is out, and what waits for it. A stream with credit
  // needs no memory.
  std::map<Key, std::optional<Value>> waiting_;
  std::uint64_t replaced_ = 0;
  std::uint64_t dropped_ = 0;
};

} // namespace sofof
