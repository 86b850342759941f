// Finds the ITS message in a frame as sniffers capture it.
// Source: ETSI EN 302 636-4-1 v1.4.1 (section 9), EN 302 636-5-1 v2.2.1
// (section 7), TS 103 097 v2.1.1 on IEEE 1609.2; IEEE 802.11, 802.1Q;
// radiotap.org.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

namespace sofof::messages {

/// How a frame begins. Source: LINKTYPE_ values of libpcap.
enum class link_layer : std::uint8_t {
  ethernet,
  ieee80211,      ///< As it is on the air, in a frame of data.
  radiotap,       ///< What a receiver says of it, then IEEE 802.11.
  linux_cooked,   ///< Of all interfaces at once.
  linux_cooked_2, ///< Likewise, the newer one.
};

/// An ITS message and what is around it.
struct btp_packet {
  std::uint16_t port = 0; ///< Its destination: the kind of message.
  bool is_signed = false; ///< By a signature that nobody has verified.
  std::span<const std::byte> message{}; ///< In the frame.
};

/// A frame that carries no ITS message: another protocol, a beacon.
struct other_packet {};

/// A frame that should carry one but is broken or cannot be read.
struct broken_packet {
  std::string_view why; ///< A sentence without its full stop.
};

using captured_packet = std::variant<other_packet, btp_packet, broken_packet>;

/// @param frame  Any octets. What follows the GeoNetworking payload, such as
///               a checksum, does not count.
captured_packet find_message(link_layer begins_with,
                             std::span<const std::byte> frame);

} // namespace sofof::messages
