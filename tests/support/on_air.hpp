// ITS messages for tests, at a place on Earth of their own.
#pragma once

#include "messages/broadcast/decode_broadcast.hpp"
#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/perception.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <vector>

namespace sofof::test {

/// @returns where made-up maps lie.
inline messages::georeference_ptr in_ulm() {
  static const auto here = std::make_shared<const messages::georeference>();
  return here;
}

/// @returns what reads the CAMs and CPMs of the vehicles there.
inline auto decode_in_ulm() {
  return [where = in_ulm()](const messages::its_pdu& message, time_point now) {
    return messages::decode(message, *where, now);
  };
}

/// @returns what a vehicle sends that moves like this, at a whole millisecond.
inline messages::its_pdu pdu_of(const messages::cam& own) {
  return messages::encoded(messages::make_cam(own, {}, *in_ulm()));
}

/// @returns what a vehicle sends that sees these objects now.
inline messages::its_pdu
pdu_of(const messages::cam& own,
       const std::vector<messages::known_object>& seen) {
  return messages::encoded(messages::make_cpm_tr103562(
      {own, own.at, seen, seen.size(), nullptr}, {}, *in_ulm()));
}

/// @returns the message if it is one of this kind.
template <class Message>
std::optional<Message> message_in(const messages::its_pdu& pdu) {
  const auto octets = pdu.view();
  if (octets.size() < 2 || octets[0] != std::byte{Message::protocol_version}
      || octets[1] != std::byte{Message::message_id})
    return std::nullopt;
  Message message;
  REQUIRE(messages::etsi::decode(octets, message));
  return message;
}

/// @returns those of the kind, in order.
template <class Message>
std::vector<Message> messages_in(const std::vector<messages::its_pdu>& all) {
  std::vector<Message> found;
  for (const auto& pdu : all)
    if (auto message = message_in<Message>(pdu))
      found.push_back(std::move(*message));
  return found;
}

/// @returns the motion that a CAM tells.
inline messages::cam motion_in(const messages::its_pdu& pdu, time_point now) {
  const auto message = message_in<messages::etsi::cam>(pdu);
  REQUIRE(message);
  const auto own = messages::read_cam(*message, {}, *in_ulm(), now);
  REQUIRE(own);
  return *own;
}

} // namespace sofof::test
