// Who is behind each connection that the TLS acceptor carries.
#pragma once

#include "network/keys/identity.hpp"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace sofof::network {

/// Knows the peers of carried connections by the loopback port that their
/// octets come from, which no other process can use meanwhile. Any thread may
/// call these.
class peer_register {
public:
  /// Call it before anything is sent from this port.
  void add(std::uint16_t port, peer_identity who) {
    const std::lock_guard lock{mutex_};
    by_port_.insert_or_assign(port, std::move(who));
  }

  /// Call it before the port is closed.
  void remove(std::uint16_t port) {
    const std::lock_guard lock{mutex_};
    by_port_.erase(port);
  }

  /// @returns whose octets come from this port; nobody's for other ports.
  std::optional<peer_identity> find(std::uint16_t port) const {
    const std::lock_guard lock{mutex_};
    const auto at = by_port_.find(port);
    if (at == by_port_.end())
      return std::nullopt;
    return at->second;
  }

private:
  mutable std::mutex mutex_;
  std::map<std::uint16_t, peer_identity> by_port_;
};

} // namespace sofof::network
