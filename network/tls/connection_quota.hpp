// How many connections there may be, in all and per peer.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace sofof::network {

/// Counts open connections, and says whether there may be one more. Any thread
/// may call these.
class connection_quota {
public:
  connection_quota(std::size_t most, std::size_t most_per_peer)
      : most_{most}, most_per_peer_{most_per_peer} {}

  /// Lets a connection of this peer in, unless the quota is full.
  /// @returns why it is, as words about the peer, "it"; empty: it is let in.
  std::string admit(const std::string& peer) {
    const std::lock_guard lock{mutex_};
    if (open_ >= most_)
      return "all " + std::to_string(most_) + " connections are taken";
    const auto at = by_peer_.find(peer);
    if (at != by_peer_.end() && at->second >= most_per_peer_)
      return "it has " + std::to_string(most_per_peer_)
             + " connections already, the most a peer may have";
    ++by_peer_[peer];
    ++open_;
    return {};
  }

  /// One of this peer's connections has ended.
  void release(const std::string& peer) {
    const std::lock_guard lock{mutex_};
    --open_;
    if (const auto at = by_peer_.find(peer); --at->second == 0)
      by_peer_.erase(at);
  }

  std::size_t open() const {
    const std::lock_guard lock{mutex_};
    return open_;
  }
  bool is_full() const { return open() >= most_; }

private:
  const std::size_t most_;
  const std::size_t most_per_peer_;
  mutable std::mutex mutex_;
  std::size_t open_ = 0;
  std::map<std::string, std::size_t> by_peer_; // none with 0
};

} // namespace sofof::network
