// ITS messages as datagrams: a BTP-B header and the message, as ROS 2 packages
// give and take them.
// Sources: ETSI EN 302 636-5-1 v2.2.1 (section 7.3); the UDP topics of
// etsi_its_conversion, github.com/ika-rwth-aachen/etsi_its_messages.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::messages {

/// No datagram with a message is longer, octets.
inline constexpr std::size_t longest_datagram = 2048;

/// @param message  A CAM, CPM or MCM.
/// @returns its datagram; empty for messages of other kinds, and too long ones.
std::vector<std::byte> btp_datagram(std::span<const std::byte> message);

/// @returns the message in a datagram; nullopt if it is for a port of none of
/// ours, or of another kind than its port says.
std::optional<std::vector<std::byte>>
message_in(std::span<const std::byte> datagram);

} // namespace sofof::messages
