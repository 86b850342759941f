// What a message takes on the air.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/octets.hpp"
#include "messages/v2x/geonet.hpp"

#include <cstddef>

namespace sofof::messages {

/// @returns an ITS message with what the layers below add to it.
inline std::size_t octets_on_air(const its_pdu& message) {
  return message.octets.size() + geonet_octets;
}

/// @returns anything else as our own protocol has it, and what the layers
/// below add to an ITS message that is a part of it.
template <class Message>
std::size_t octets_on_air(const Message& message) {
  auto octets = octets_of(message);
  if constexpr (requires { message.what.type(); })
    if (message.what.template as<its_pdu>())
      octets += geonet_octets;
  return octets;
}

} // namespace sofof::messages
