// What a message takes on the air, what it is for, and how it arrives.
#pragma once

#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/octets.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/geonet.hpp"

#include <concepts>
#include <cstddef>
#include <string_view>

namespace sofof::actors {

/// @returns an ITS message with what the layers below add to it.
inline std::size_t octets_on_air(const messages::its_pdu& message) {
  return message.octets.size() + messages::geonet_octets;
}

/// @returns anything else as our own protocol has it, and what the layers
/// below add to an ITS message that is a part of it.
template <class Message>
std::size_t octets_on_air(const Message& message) {
  auto octets = messages::octets_of(message);
  if constexpr (requires { message.what.type(); })
    if (message.what.template as<messages::its_pdu>())
      octets += messages::geonet_octets;
  return octets;
}

/// @returns the kind of an ITS message.
inline std::string_view purpose_of(const messages::its_pdu& message) {
  constexpr std::size_t id = 1; // the octet of the message's id
  if (message.octets.size() <= id)
    return "other";
  switch (std::to_integer<unsigned>(message.octets[id])) {
    case messages::etsi::cam::message_id:
      return "CAM";
    case messages::etsi::mcm::message_id:
      return "MCM";
    case messages::etsi::tr103562::cpm::message_id:
      return "CPM"; // of both releases
    default:
      return "other";
  }
}

/// @returns the service that a message is for; of those that agree on several,
/// the protocol.
template <class Message>
std::string_view purpose_of(const Message& message) {
  if constexpr (requires { message.session.service; })
    return message.session.service.view();
  else
    return "protocol";
}

/// @returns the message as it arrives after that way.
template <class Message>
Message after(Message message, const messages::transit& way) {
  if constexpr (std::same_as<Message, messages::service_input>)
    message.up = way;
  else if constexpr (std::same_as<Message, messages::service_result>)
    message.timing.down = way;
  return message;
}

} // namespace sofof::actors
