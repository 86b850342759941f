// The layers below an ITS message, as sniffers see them.
#include "messages/v2x/geonet.hpp"

#include <algorithm>
#include <concepts>

namespace sofof::messages {

namespace {

constexpr std::uint16_t geonet_ethertype = 0x8947;

// Basic header.
constexpr std::uint8_t version_1_common = 0x11; // then comes the common header
constexpr std::uint8_t one_second = 0x05;       // base 1 s, once
constexpr std::uint8_t one_hop = 1;

// Common header.
constexpr std::uint8_t carries_btp_b = 0x20;
constexpr std::uint8_t single_hop_broadcast = 0x50;
constexpr std::uint8_t traffic_class_2 = 2;
constexpr std::uint8_t mobile = 0x80;

constexpr std::size_t btp_octets = 4;
// Of 15 bits with a sign, below the position accuracy indicator.
constexpr std::uint16_t fastest = 0x3fff;

/// Big-endian, as the networks have it.
void append(std::string& out, std::integral auto x) {
  for (int shift = 8 * (static_cast<int>(sizeof x) - 1); shift >= 0; shift -= 8)
    out += static_cast<char>(static_cast<std::uint64_t>(x) >> shift & 0xff);
}

/// 02:00 and the station: an address that its owner has made up.
void append_address(std::string& out, std::uint32_t station) {
  append(out, std::uint16_t{0x0200});
  append(out, station);
}

} // namespace

void append_frame(std::string& out, const geonet_sender& from,
                  std::uint16_t port, std::span<const std::byte> message) {
  out.append(6, '\xff'); // to everybody
  append_address(out, from.station);
  append(out, geonet_ethertype);

  append(out, version_1_common);
  append(out, std::uint8_t{0});
  append(out, one_second);
  append(out, one_hop);

  append(out, carries_btp_b);
  append(out, single_hop_broadcast);
  append(out, traffic_class_2);
  append(out, from.is_mobile ? mobile : std::uint8_t{0});
  append(out, static_cast<std::uint16_t>(btp_octets + message.size()));
  append(out, one_hop);
  append(out, std::uint8_t{0});

  append(out, static_cast<std::uint16_t>(from.station_type << 10));
  append_address(out, from.station);
  append(out, static_cast<std::uint32_t>(from.at_ms)); // modulo 2^32
  append(out, from.latitude);
  append(out, from.longitude);
  append(out, std::min(from.speed_cmps, fastest));
  append(out, from.heading);
  append(out, std::uint32_t{0}); // what a station would tell of congestion

  append(out, port);
  append(out, std::uint16_t{0});
  out.append(reinterpret_cast<const char*>(message.data()), message.size());
}

} // namespace sofof::messages
