// What a message of another station says.
#include "messages/broadcast/decode_broadcast.hpp"

#include "messages/etsi/uper.hpp"
#include "messages/v2x/cam_content.hpp"

#include <optional>

namespace sofof::messages {

namespace {

template <class Word>
broadcast word_of(std::optional<Word> word) {
  if (!word)
    return {};
  return std::move(*word);
}

} // namespace

broadcast decode(const its_pdu& message, const georeference& where,
                 time_point now) {
  if (message.ahead != duration{})
    return decode(its_pdu{message.octets}, where.ahead_by(message.ahead), now);
  const auto octets = message.view();
  if (etsi::cam in; etsi::decode(octets, in))
    return word_of(read_cam(in, {}, where, now));
  if (etsi::tr103562::cpm in; etsi::decode(octets, in))
    return word_of(read_cpm(in, where, now));
  if (etsi::ts103324::cpm in; etsi::decode(octets, in))
    return word_of(read_cpm(in, where));
  if (etsi::mcm in; etsi::decode(octets, in))
    return word_of(read_word(in, where, now));
  return {};
}

} // namespace sofof::messages
