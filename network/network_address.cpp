// HOST:PORT, read and written.
#include "network/network_address.hpp"

#include <charconv>
#include <system_error>

namespace sofof::network {

namespace {

constexpr std::size_t longest_host = 253; // RFC 1035

} // namespace

std::optional<network_address> parse_address(std::string_view text) {
  const auto colon = text.rfind(':');
  if (colon == text.npos)
    return std::nullopt;
  auto host = text.substr(0, colon);
  const auto digits = text.substr(colon + 1);
  const auto in_brackets = host.starts_with('[') && host.ends_with(']');
  if (in_brackets)
    host = host.substr(1, host.size() - 2);
  else if (host.find(':') != host.npos)
    return std::nullopt;
  if (host.empty() || host.size() > longest_host
      || host.find_first_of(" []\t\n/") != host.npos)
    return std::nullopt;
  network_address address{std::string{host}, 0};
  const auto* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, address.port);
  if (error != std::errc{} || rest != end)
    return std::nullopt;
  return address;
}

std::string print_address(const network_address& address) {
  const auto& host = address.host;
  const auto port = ":" + std::to_string(address.port);
  return host.find(':') == host.npos ? host + port : "[" + host + "]" + port;
}

} // namespace sofof::network
