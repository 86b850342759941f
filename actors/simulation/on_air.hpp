// What a message on the air is for, and how it arrives.
#pragma once

#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"

#include <concepts>
#include <string_view>

namespace sofof::actors {

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
