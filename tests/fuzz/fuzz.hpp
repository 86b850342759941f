// What holds for any octets: they are refused, or they are a message that can
// be sent on.
#pragma once

#include "messages/etsi/explain.hpp"
#include "messages/etsi/json.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace sofof::fuzz {

inline void require(bool holds) {
  if (!holds)
    std::abort();
}

inline std::span<const std::byte> octets_of(const std::uint8_t* data,
                                            std::size_t size) {
  return std::as_bytes(std::span{data, size});
}

template <class T>
std::vector<std::byte> encoded(const T& message) {
  std::vector<std::byte> out(messages::etsi::encoded_size(message));
  require(messages::etsi::encode(message, out) == out.size());
  return out;
}

/// Tries a decoder of one kind of message on octets without their first two,
/// which tell the kind.
template <class T>
int try_kind(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> whole;
  for (const auto octet : messages::etsi::key_of<T>)
    whole.push_back(std::byte{octet});
  const auto rest = octets_of(data, size);
  whole.insert(whole.end(), rest.begin(), rest.end());
  T message;
  const auto is_read = messages::etsi::decode(whole, message);
  require(is_read == messages::etsi::explain_decoding<T>(whole).empty());
  if (!is_read)
    return 0;
  const auto first = encoded(message);
  require(messages::etsi::decode(first, message));
  require(encoded(message) == first);
  return 0;
}

} // namespace sofof::fuzz
