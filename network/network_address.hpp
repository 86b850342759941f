// Where a process listens or connects to: HOST:PORT.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::network {

struct network_address {
  std::string host; ///< A name, an IPv4 or an IPv6 address.
  std::uint16_t port = 0;

  bool operator==(const network_address&) const = default;
};

/// Reads "edge.example:3333", "10.0.0.1:3333" or "[fd00::1]:3333".
/// @returns nullopt for anything else.
std::optional<network_address> parse_address(std::string_view text);

/// @returns what `parse_address` reads as this address.
std::string print_address(const network_address& address);

} // namespace sofof::network
