// Prefixes of addresses, counted.
#include "network/tls/fair_share.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <netinet/in.h>
#include <vector>

namespace sofof::network {

namespace {

/// Above the 24 bits of an IPv4 prefix: of IPv6, ::/8 is nobody's.
constexpr std::uint64_t is_ipv4 = std::uint64_t{1} << 24;

network_prefix ipv4_prefix(std::uint32_t address) {
  constexpr int host_bits = 8;
  return {is_ipv4 | address >> host_bits};
}

std::uint64_t big_endian(const std::uint8_t* octets, std::size_t count) {
  constexpr int octet = 8;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << octet | octets[i];
  return value;
}

} // namespace

network_prefix prefix_of(const socket_address& address) {
  if (address.storage.ss_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &address.storage, sizeof v4);
    return ipv4_prefix(ntohl(v4.sin_addr.s_addr));
  }
  sockaddr_in6 v6{};
  std::memcpy(&v6, &address.storage, sizeof v6);
  const auto* octets = v6.sin6_addr.s6_addr;
  constexpr std::size_t mapped = 12; // octets of ::ffff:0:0/96
  if (IN6_IS_ADDR_V4MAPPED(&v6.sin6_addr))
    return ipv4_prefix(static_cast<std::uint32_t>(
        big_endian(octets + mapped, sizeof(std::uint32_t))));
  return {big_endian(octets, sizeof(std::uint64_t))};
}

std::size_t choose_victim(std::span<const network_prefix> prefixes,
                          double draw) {
  assert(!prefixes.empty() && draw >= 0 && draw < 1);
  std::map<network_prefix, std::size_t> counts;
  std::size_t most = 0;
  for (const auto& prefix : prefixes)
    most = std::max(most, ++counts[prefix]);
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < prefixes.size(); ++i)
    if (counts[prefixes[i]] == most)
      candidates.push_back(i);
  const auto size = candidates.size();
  const auto n = static_cast<std::size_t>(draw * static_cast<double>(size));
  return candidates[std::min(n, size - 1)];
}

} // namespace sofof::network
