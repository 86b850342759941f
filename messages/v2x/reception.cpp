// What a message of another station says.
#include "messages/v2x/reception.hpp"

#include "messages/etsi/uper.hpp"
#include "messages/v2x/awareness.hpp"

#include <optional>

namespace sofof {

namespace {

template <class Word>
broadcast_word word_of(std::optional<Word> word) {
  if (!word)
    return {};
  return std::move(*word);
}

/// Whether the message begins as this type's do.
template <class Message>
bool is_a(std::span<const std::byte> octets) {
  return octets.size() > 2 && octets[0] == std::byte{Message::protocol_version}
         && octets[1] == std::byte{Message::message_id};
}

} // namespace

broadcast_word understand(const its_pdu& message, const datum& where,
                          time_point now) {
  const auto octets = message.view();
  if (is_a<etsi::cam>(octets))
    if (etsi::cam in; etsi::decode(octets, in))
      return word_of(read_cam(in, {}, where, now));
  if (is_a<etsi::tr103562::cpm>(octets))
    if (etsi::tr103562::cpm in; etsi::decode(octets, in))
      return word_of(read_cpm(in, where, now));
  if (is_a<etsi::ts103324::cpm>(octets))
    if (etsi::ts103324::cpm in; etsi::decode(octets, in))
      return word_of(read_cpm(in, where));
  return {};
}

} // namespace sofof
