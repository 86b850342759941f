// The layers below an ITS message, as sniffers see them: Ethernet,
// GeoNetworking single-hop broadcast, BTP-B.
// Source: ETSI EN 302 636-4-1 v1.4.1 (sections 9.5 to 9.8), EN 302 636-5-1
// v2.2.1 (section 7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sofof::messages {

/// Destination ports of BTP. Source: ETSI TS 103 248 v2.1.1; the MCM has none
/// yet, 2020 is what ETSI's own drafts and ROS packages of it use.
namespace btp_port {
inline constexpr std::uint16_t cam = 2001;
inline constexpr std::uint16_t cpm = 2009;
inline constexpr std::uint16_t mcm = 2020;
} // namespace btp_port

/// Who sends, and where it is: the long position vector, in ETSI's units.
struct geonet_sender {
  std::uint32_t station = 0; ///< Also in its made-up addresses.
  std::uint8_t station_type = 0;
  std::uint64_t at_ms = 0;    ///< TimestampIts.
  std::int32_t latitude = 0;  ///< 1e-7 °
  std::int32_t longitude = 0; ///< 1e-7 °
  std::uint16_t speed_cmps = 0;
  std::uint16_t heading = 0; ///< 0.1 °, clockwise from north.
  bool is_mobile = true;
};

/// What the lower layers add to a message on the air, without Ethernet:
/// GeoNetworking and BTP-B.
inline constexpr std::size_t geonet_octets = 4 + 8 + 28 + 4;

/// Appends an Ethernet frame that carries one message by broadcast. Its
/// position is not said to be accurate: nobody knows how good it is.
void append_frame(std::string& out, const geonet_sender& from,
                  std::uint16_t port, std::span<const std::byte> message);

} // namespace sofof::messages
