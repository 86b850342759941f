// Messages of random content, from their descriptions alone.
#pragma once

#include "messages/etsi/schema.hpp"
#include "tests/support/dice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sofof::test {

/// Fills whatever schema.hpp can describe with values that may be encoded.
class random_pdu {
public:
  /// How much of what may be left out is there.
  struct mix {
    double presence = 0.5;   ///< Of optional members, from 0 to 1.
    std::size_t longest = 3; ///< Elements of a list beyond the fewest.
  };

  explicit random_pdu(std::uint64_t seed, mix m) : dice_{seed}, mix_{m} {}
  explicit random_pdu(std::uint64_t seed) : random_pdu{seed, mix{}} {}

  template <class T>
  T make() {
    T x{};
    fill(x);
    return x;
  }
  /// A whole message: its header says which it is.
  template <class T>
  T message() {
    T x{};
    fill(x.header.station);
    fill(x.body);
    return x;
  }

  template <class T>
  void fill(T& x) {
    using namespace messages::etsi;
    if constexpr (std::is_same_v<T, bool>) {
      x = happens(0.5);
    } else if constexpr (is_integer<T>) {
      x.value = static_cast<typename T::number>(number(T::low, T::high));
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(number(0, messages::etsi::names_of<T>.count - 1));
    } else if constexpr (is_bit_string<T>) {
      for (unsigned i = 0; i < T::width; ++i)
        if (happens(0.5))
          x.set(i);
    } else if constexpr (is_optional<T>) {
      if (happens(mix_.presence))
        fill(x.emplace());
      else
        x.reset();
    } else if constexpr (is_defaulted<T>) {
      if (happens(mix_.presence))
        fill(x.value);
    } else if constexpr (is_sequence_of<T>) {
      x.resize(index(std::min(mix_.longest, T::high - T::low) + 1) + T::low);
      for (auto& element : x)
        fill(element);
    } else if constexpr (is_choice<T>) {
      fill_one<T::count>(x.value, index(T::count));
    } else if constexpr (is_open_type<T>) {
      const auto which = index(T::count + 1);
      if (which < T::count)
        fill_one<T::count>(x.value, which);
      else
        fill_unknown(x);
    } else {
      T::fields(x, [this](std::string_view, auto& member) { fill(member); });
    }
  }

private:
  bool happens(double chance) { return dice_.between(0, 1) < chance; }
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(
        dice_.between(0, static_cast<double>(count)));
  }
  // The ends of a range are where mistakes are.
  std::int64_t number(std::int64_t low, std::int64_t high) {
    if (happens(0.1))
      return happens(0.5) ? low : high;
    const auto drawn =
        dice_.between(static_cast<double>(low), static_cast<double>(high) + 1);
    return std::clamp(static_cast<std::int64_t>(std::floor(drawn)), low, high);
  }

  template <std::size_t count, class Variant>
  void fill_one(Variant& value, std::size_t which) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      ((which == i ? fill(value.template emplace<i>()) : void()), ...);
    }
    (std::make_index_sequence<count>{});
  }
  template <class T>
  void fill_unknown(T& x) {
    using id = typename T::id_type;
    do
      fill(x.unknown_id);
    while (std::ranges::find(T::ids, std::int64_t{x.unknown_id.value})
           != T::ids.end());
    static_assert(T::count <= id::span, "every id is known");
    auto& octets = x.value.template emplace<messages::etsi::opaque>().octets;
    octets.resize(1 + index(mix_.longest + 1));
    for (auto& octet : octets)
      octet = static_cast<std::byte>(number(0, 255));
  }

  dice dice_;
  mix mix_;
};

} // namespace sofof::test
