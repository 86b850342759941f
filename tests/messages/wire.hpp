// Messages as bytes, as CAF sends them between processes.
#pragma once

#include <caf/binary_deserializer.hpp>
#include <caf/binary_serializer.hpp>
#include <caf/byte_buffer.hpp>

#include <optional>

namespace sofof::test {

template <class T>
caf::byte_buffer save(const T& x) {
  caf::byte_buffer bytes;
  caf::binary_serializer sink{nullptr, bytes};
  if (!sink.apply(x))
    bytes.clear();
  return bytes;
}

/// @returns the message that the bytes hold, all of them; nullopt when they
/// do not fit.
template <class T>
std::optional<T> load(const caf::byte_buffer& bytes) {
  T x;
  caf::binary_deserializer source{nullptr, bytes};
  if (!source.apply(x) || source.remaining() != 0)
    return std::nullopt;
  return x;
}

} // namespace sofof::test
