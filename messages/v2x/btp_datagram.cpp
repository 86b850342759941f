// The kind of a message stands in its second octet.
#include "messages/v2x/btp_datagram.hpp"

#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/v2x/geonet.hpp"

#include <cstdint>

namespace sofof::messages {

namespace {

constexpr std::size_t btp_header_octets = 4;

/// @returns 0 for what has none.
std::uint16_t port_of(std::span<const std::byte> message) {
  constexpr std::size_t header = 6, id = 1;
  if (message.size() < header)
    return 0;
  switch (std::to_integer<unsigned>(message[id])) {
    case etsi::cam::message_id:
      return btp_port::cam;
    case etsi::tr103562::cpm::message_id:
      return btp_port::cpm; // of both releases
    case etsi::mcm::message_id:
      return btp_port::mcm;
    default:
      return 0;
  }
}

} // namespace

std::vector<std::byte> btp_datagram(std::span<const std::byte> message) {
  const auto port = port_of(message);
  if (port == 0 || message.size() > longest_datagram - btp_header_octets)
    return {};
  std::vector<std::byte> all;
  all.reserve(btp_header_octets + message.size());
  all.push_back(static_cast<std::byte>(port >> 8));
  all.push_back(static_cast<std::byte>(port & 0xff));
  all.resize(btp_header_octets); // no details of the port
  all.insert(all.end(), message.begin(), message.end());
  return all;
}

std::optional<std::vector<std::byte>>
message_in(std::span<const std::byte> datagram) {
  if (datagram.size() < btp_header_octets || datagram.size() > longest_datagram)
    return std::nullopt;
  const auto port = std::to_integer<unsigned>(datagram[0]) << 8
                    | std::to_integer<unsigned>(datagram[1]);
  const auto message = datagram.subspan(btp_header_octets);
  if (port == 0 || port != port_of(message))
    return std::nullopt;
  return std::vector<std::byte>{message.begin(), message.end()};
}

} // namespace sofof::messages
