// Numbers and types of a message, as CAF's binary serializer writes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace sofof::actors {

/// Reads a payload from its beginning on, and nothing past its end.
class frame_reader {
public:
  explicit frame_reader(std::span<const std::byte> octets) : left_{octets} {}

  /// @param octets  Its size, 1 or 2.
  /// @returns nothing at the end.
  std::optional<std::uint16_t> number(std::size_t octets);

  /// @returns a size below 2^14: of one octet or two, and of no more than it
  /// needs; nothing if there is none.
  std::optional<std::size_t> short_size();

  /// @returns how many octets have not been read.
  std::size_t left() const { return left_.size(); }

private:
  std::span<const std::byte> left_;
};

/// The ids of the types of a message's elements.
class element_types {
public:
  /// Reads them after the actors that the message is forwarded to, of which
  /// there must be none.
  /// @returns nothing if there are some, or more types than in any message of
  /// ours.
  static std::optional<element_types> read(frame_reader& in);

  bool are(std::span<const std::uint16_t> others) const;

private:
  std::array<std::uint16_t, 8> types_{};
  std::size_t count_ = 0;
};

} // namespace sofof::actors
