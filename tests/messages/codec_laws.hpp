// What must hold for every message that can be encoded.
#pragma once

#include "messages/etsi/uper.hpp"
#include "tests/support/each_number.hpp"
#include "tests/support/hex.hpp"
#include "tests/support/random_pdu.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

namespace sofof::test {

/// @returns nothing if it is refused.
template <class T>
octets uper_of(const T& message) {
  static std::array<std::byte, 1 << 16> room;
  const auto size = messages::etsi::encode(message, room);
  return {room.begin(), room.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// Vectors of an independent codec come back octet by octet.
template <class T>
void check_vectors(const std::string& name) {
  const auto path = SOFOF_SOURCE_DIR "/../shared/data/v2x/" + name;
  const auto vectors = read_hex_file(path);
  if (vectors.empty())
    MESSAGE("SKIPPED: no ", path);
  T message;
  for (const auto& vector : vectors) {
    CAPTURE(to_hex(vector));
    REQUIRE(messages::etsi::decode(vector, message));
    CHECK(to_hex(uper_of(message)) == to_hex(vector));
  }
}

template <class T>
void check_random_messages(int count) {
  T again; // its room is used again
  for (int seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    random_pdu random{static_cast<std::uint64_t>(seed),
                      {.presence = seed % 5 / 4.0, .longest = 4}};
    const auto sent = uper_of(random.message<T>());
    REQUIRE_FALSE(sent.empty());
    REQUIRE(messages::etsi::decode(sent, again));
    CHECK(to_hex(uper_of(again)) == to_hex(sent));
  }
}

/// Every number may be as small and as large as its range, and no more so.
template <class T>
void check_ranges(int count) {
  for (int seed = 0; seed < count; ++seed) {
    random_pdu random{static_cast<std::uint64_t>(seed), {.presence = 1}};
    auto message = random.message<T>();
    each_number(message.body, [&]<class N>(N& x) {
      if constexpr (N::may_grow == messages::etsi::growth::closed) {
        using limits = std::numeric_limits<typename N::number>;
        const auto is_taken = [&](std::int64_t value) {
          const auto before =
              std::exchange(x.value, static_cast<typename N::number>(value));
          const auto taken = !uper_of(message).empty();
          x.value = before;
          return taken;
        };
        CHECK(is_taken(N::low));
        CHECK(is_taken(N::high));
        if (N::low > std::int64_t{limits::min()})
          CHECK_FALSE(is_taken(N::low - 1));
        if (static_cast<std::uint64_t>(N::high)
            < static_cast<std::uint64_t>(limits::max()))
          CHECK_FALSE(is_taken(N::high + 1));
      }
    });
  }
}

/// A message that ends early is refused, wherever.
template <class T>
void check_truncation(int count) {
  for (int seed = 0; seed < count; ++seed) {
    random_pdu random{static_cast<std::uint64_t>(seed), {.presence = 0.9}};
    const auto whole = uper_of(random.message<T>());
    for (std::size_t size = 0; size < whole.size(); ++size) {
      // Of its own, so that reading on is noticed.
      const octets part(whole.data(), whole.data() + size);
      T message;
      CHECK_FALSE(messages::etsi::decode(part, message));
    }
  }
}

/// Octets with a few bits turned are decoded or refused, and what is decoded
/// can be encoded.
template <class T>
void check_damage(int count) {
  T message;
  for (int seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    random_pdu random{static_cast<std::uint64_t>(seed)};
    auto damaged = uper_of(random.message<T>());
    dice where{static_cast<std::uint64_t>(seed)};
    for (int i = 0; i < 4; ++i) {
      const auto bit = static_cast<std::size_t>(
          where.between(0, 8 * static_cast<double>(damaged.size())));
      damaged[bit / 8] ^= std::byte{1} << bit % 8;
    }
    if (messages::etsi::decode(damaged, message))
      CHECK_FALSE(uper_of(message).empty());
  }
}

/// What a later version adds to the last sequence of a message is skipped.
/// @param grows_at  The bit that says that it has additions.
template <class T>
void check_additions(std::size_t grows_at) {
  random_pdu random{1};
  const auto message = random.message<T>();
  messages::etsi::bit_counter size;
  messages::etsi::write(size, message);
  auto bits = to_bits(uper_of(message)).substr(0, size.bits());
  bits[grows_at] = '1';
  bits += "0000010"; // three may be there,
  bits += "101";     // two of them are:
  bits += "00000001"
          "10101010"; // one octet,
  bits += "00000010"
          "1111111100000000"; // two octets
  T decoded;
  REQUIRE(messages::etsi::decode(from_bits(bits), decoded));
  CHECK(to_hex(uper_of(decoded)) == to_hex(uper_of(message)));
}

} // namespace sofof::test
