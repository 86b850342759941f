// Sequences that always take the same few bits, as one number: what is made
// of many small fields is encoded and decoded several times faster so.
#pragma once

#include "messages/etsi/bits.hpp"
#include "messages/etsi/schema.hpp"

namespace sofof::messages::etsi {

/// The widest number that bits are put into.
inline constexpr unsigned word_width = 64;
/// The width of a type that takes more than a word, or not always the same.
inline constexpr unsigned no_fixed_width = word_width + 1;

template <class T>
consteval unsigned fixed_width();

struct width_sum {
  unsigned bits = 0;

  template <class T>
  constexpr void operator()(std::string_view, const T&) {
    bits = std::min(bits + fixed_width<T>(), no_fixed_width);
  }
};
template <class T>
constexpr unsigned width_of_members(const T& x) {
  width_sum sum;
  T::fields(x, sum);
  return sum.bits;
}
/// A sequence whose members can be looked at while compiling: one with a long
/// list cannot, and need not.
template <class T>
concept transparent = requires {
  typename std::integral_constant<unsigned, width_of_members(T{})>;
};

/// Types whose width depends on their value.
template <class T>
inline constexpr bool is_loose =
    is_optional<
        T> || is_defaulted<T> || is_choice<T> || is_sequence_of<T> || is_open_type<T> || sequence_may_grow<T>();

/// How many bits a type takes, whatever its value.
template <class T>
consteval unsigned fixed_width() {
  auto width = no_fixed_width;
  if constexpr (std::is_same_v<T, bool>) {
    width = 1;
  } else if constexpr (std::is_enum_v<T>) {
    using names = std::remove_cvref_t<decltype(names_of<T>)>;
    if (names::may_grow != extensible)
      width = static_cast<unsigned>(std::bit_width(names::count - 1));
  } else if constexpr (is_integer<T> || is_bit_string<T>) {
    if (T::may_grow != extensible)
      width = T::width;
  } else if constexpr (!is_loose<T>) {
    if constexpr (transparent<T>)
      width = width_of_members(T{});
  }
  return width;
}

struct packer {
  std::uint64_t bits = 0;
  bool fits = true; // every number its range

  template <class T>
  constexpr void operator()(std::string_view, const T& x) {
    if constexpr (is_integer<T>) {
      const auto offset = static_cast<std::uint64_t>(x.value)
                          - static_cast<std::uint64_t>(T::low);
      add(offset, T::width, offset <= T::span);
    } else if constexpr (std::is_enum_v<T>) {
      const auto index = static_cast<std::uint64_t>(x);
      add(index, fixed_width<T>(), index < names_of<T>.count);
    } else if constexpr (is_bit_string<T>) {
      add(x.bits, T::width, x.bits <= T::all);
    } else if constexpr (std::is_same_v<T, bool>) {
      add(x, 1, true);
    } else {
      T::fields(x, *this);
    }
  }
  constexpr void add(std::uint64_t value, unsigned width, bool is_in_range) {
    bits = bits << width | value;
    fits = fits && is_in_range;
  }
};

struct unpacker {
  std::uint64_t bits;
  unsigned left; // of them, the lowest, are still to be read
  bool fits = true;

  template <class T>
  constexpr void operator()(std::string_view, T& x) {
    if constexpr (is_integer<T>) {
      const auto offset = read_bits(T::width);
      fits = fits && offset <= T::span;
      x.value = static_cast<typename T::number>(
          static_cast<std::int64_t>(offset) + T::low);
    } else if constexpr (std::is_enum_v<T>) {
      const auto index = read_bits(fixed_width<T>());
      fits = fits && index < names_of<T>.count;
      x = static_cast<T>(index);
    } else if constexpr (is_bit_string<T>) {
      x.bits = static_cast<std::uint32_t>(read_bits(T::width));
    } else if constexpr (std::is_same_v<T, bool>) {
      x = read_bits(1) == 1;
    } else {
      T::fields(x, *this);
    }
  }
  constexpr std::uint64_t read_bits(unsigned width) {
    left -= width;
    return bits >> left & ((std::uint64_t{1} << width) - 1);
  }
};

/// Whether a sequence is coded at once. Who follows the path to a fault goes
/// through its members instead.
template <class Bits, class T>
inline constexpr bool is_packed =
    (std::is_same_v<
         Bits,
         bit_writer> || std::is_same_v<Bits, bit_counter> || std::is_same_v<Bits, bit_reader>)&&fixed_width<T>()
    < word_width;

template <class Out, class T>
void write_packed(Out& out, const T& x) {
  packer members;
  T::fields(x, members);
  if (!members.fits)
    out.fail(fault::out_of_range);
  out.put(members.bits, fixed_width<T>());
}

template <class In, class T>
void read_packed(In& in, T& x) {
  unpacker members{in.get(fixed_width<T>()), fixed_width<T>()};
  T::fields(x, members);
  if (!members.fits)
    in.fail(fault::out_of_range);
}

} // namespace sofof::messages::etsi
