// How places for unfinished handshakes are shared out among networks.
#pragma once

#include "network/socket.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace sofof::network {

/// The addresses that one attacker easily has: a /24 of IPv4, a /64 of IPv6.
struct network_prefix {
  std::uint64_t bits = 0;

  friend auto operator<=>(const network_prefix&,
                          const network_prefix&) = default;
};

/// @returns the network that an address lies in; an IPv4 address that is
///          written as an IPv6 one (::ffff:192.0.2.1) lies in its /24.
network_prefix prefix_of(const socket_address& address);

/// Chooses the handshake that makes room for another one: of the networks that
/// have the most of them, each handshake with the same chance.
/// @param prefixes  The network of each handshake; at least one.
/// @param draw      Uniform in [0, 1).
/// @returns the index of the handshake.
std::size_t choose_victim(std::span<const network_prefix> prefixes,
                          double draw);

} // namespace sofof::network
