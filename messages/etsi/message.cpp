// Which message it is.
#include "messages/etsi/message.hpp"

#include "messages/etsi/explain.hpp"

#include <fmt/format.h>

#include <array>
#include <type_traits>
#include <utility>

namespace sofof::messages::etsi {

namespace {

template <class Visit, std::size_t... i>
void for_each_kind(Visit&& visit, std::index_sequence<i...>) {
  (visit.template operator()<std::variant_alternative_t<i, message>>(), ...);
}
constexpr std::make_index_sequence<std::variant_size_v<message>> kinds;

} // namespace

outcome<message> make_message(std::uint8_t protocol_version,
                              std::uint8_t message_id) {
  const message_key key{protocol_version, message_id};
  outcome<message> made;
  std::string known;
  for_each_kind(
      [&]<class T>() {
        if (key == key_of<T>)
          made.value.emplace(std::in_place_type<T>);
        known += (known.empty() ? "" : ", ") + text_of(key_of<T>);
      },
      kinds);
  if (!made.value)
    made.error =
        fmt::format("{} is not known, only {}", with_article(key), known);
  return made;
}

outcome<message> decode_message(std::span<const std::byte> in) {
  if (in.size() < std::tuple_size_v<message_key>)
    return {{}, "the message ends before it tells what it is"};
  const auto key = key_in(in);
  auto decoded = make_message(key[0], key[1]);
  if (decoded.value)
    decoded.error = std::visit(
        [&]<class T>(T& m) {
          return decode(in, m) ? std::string{} : explain_decoding<T>(in);
        },
        *decoded.value);
  if (!decoded.error.empty())
    decoded.value.reset();
  return decoded;
}

outcome<std::vector<std::byte>> encode_message(const message& m) {
  return std::visit(
      [](const auto& x) -> outcome<std::vector<std::byte>> {
        std::vector<std::byte> octets(encoded_size(x));
        if (encode(x, octets) == 0)
          return {{}, explain_encoding(x)};
        return {std::move(octets), {}};
      },
      m);
}

} // namespace sofof::messages::etsi
