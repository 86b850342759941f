// From a message to what is on the air.
#pragma once

#include "messages/etsi/uper.hpp"
#include "messages/protocol/its_pdu.hpp"

#include <array>

namespace sofof::messages {

/// No message of ours is longer; sized for a CPM of 128 objects.
inline constexpr std::size_t longest_message = 16 * 1024;

/// @returns the message in UPER; nothing if a value is beyond its range.
its_pdu encoded(const auto& message) {
  std::array<std::byte, longest_message> room;
  const auto octets = etsi::encode(message, room);
  return {{room.begin(), room.begin() + static_cast<std::ptrdiff_t>(octets)}};
}

} // namespace sofof::messages
