// The unaligned packed encoding rules for the types of schema.hpp.
// Source: ITU-T X.691.
#pragma once

#include "messages/etsi/uper_reader.hpp"
#include "messages/etsi/uper_writer.hpp"

#include <array>
#include <cassert>
#include <span>

namespace sofof::messages::etsi {

/// Messages that begin with a header that tells which they are.
template <class T>
concept headed = requires(const T& x) {
  T::protocol_version;
  T::message_id;
  x.header;
};

/// The first two octets of a message: protocol version and message id.
using message_key = std::array<std::uint8_t, 2>;
template <headed T>
inline constexpr message_key key_of{T::protocol_version, T::message_id};

template <headed T>
message_key key_in(const T& message) {
  return {message.header.protocol_version, message.header.message_id};
}
/// Precondition: 2 octets.
inline message_key key_in(std::span<const std::byte> in) {
  assert(in.size() >= std::tuple_size_v<message_key>);
  return {std::to_integer<std::uint8_t>(in[0]),
          std::to_integer<std::uint8_t>(in[1])};
}

/// Encodes without heap.
/// @returns how many octets of `out` it takes; 0 if something does not fit:
/// `explain_encoding` tells what.
template <class T>
std::size_t encode(const T& message, std::span<std::byte> out) {
  if constexpr (headed<T>)
    if (key_in(message) != key_of<T>)
      return 0;
  bit_writer writer{out};
  write(writer, message);
  return writer.finish();
}

/// @returns how many octets it takes.
template <class T>
std::size_t encoded_size(const T& message) {
  bit_counter counter;
  write(counter, message);
  return (counter.bits() + 7) / 8;
}

/// Reads to the end: only zero bits may follow, and fewer than 8.
template <class In, class T>
void read_all(In& in, T& x) {
  read(in, x);
  if (!in.ok())
    return;
  const auto rest = in.left();
  if (rest >= 8 || in.get(static_cast<unsigned>(rest)) != 0)
    in.fail(fault::leftover, rest);
}

/// Decodes into a message whose room is used again.
/// @returns whether all of it could be read: if not, the message is not to be
/// used, and `explain_decoding` tells why.
template <class T>
bool decode(std::span<const std::byte> in, T& message) {
  if constexpr (headed<T>)
    if (in.size() >= 2 && key_in(in) != key_of<T>)
      return false;
  bit_reader reader{in};
  read_all(reader, message);
  return reader.ok();
}

} // namespace sofof::messages::etsi
