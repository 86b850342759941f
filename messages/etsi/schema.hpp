// ASN.1 as C++ types: a message is described once, and this one description
// serves encoding, decoding, range checks and JSON.
//
//   INTEGER (lo..hi)            integer<lo, hi>, extensible_integer<lo, hi>
//   ENUMERATED                  an enum, and names_of<it>
//   BIT STRING (SIZE (n))       bit_string<n>
//   BOOLEAN                     bool
//   SEQUENCE                    a struct with fields(x, visit)
//   OPTIONAL, DEFAULT v         std::optional<T>, defaulted<T, v>
//   CHOICE                      choice<alternative<"name", T>, ...>
//   SEQUENCE OF (SIZE (a..b))   sequence_of<T, a, b>
//   "..."                       extensible
#pragma once

#include "messages/etsi/inline_list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace sofof::messages::etsi {

/// Whether a type may grow in later versions of a standard.
enum class growth : bool { closed, extensible };
inline constexpr auto extensible = growth::extensible;

/// A text that can be a template argument.
template <std::size_t n>
struct literal {
  std::array<char, n> text{};
  // NOLINTNEXTLINE(*-explicit-*): that is what it is for
  consteval literal(const char (&chars)[n]) {
    std::copy_n(chars, n, text.begin());
  }
  constexpr std::string_view view() const { return {text.data(), n - 1}; }
};

/// The smallest integer type that holds lo to hi.
template <std::int64_t lo, std::int64_t hi>
using fitting = std::conditional_t<
    (lo >= 0),
    std::conditional_t<
        (hi <= 0xff), std::uint8_t,
        std::conditional_t<(hi <= 0xffff), std::uint16_t,
                           std::conditional_t<(hi <= 0xffff'ffff),
                                              std::uint32_t, std::uint64_t>>>,
    std::conditional_t<
        (lo >= -0x8000 && hi <= 0x7fff), std::int16_t,
        std::conditional_t<(lo >= -0x8000'0000LL && hi <= 0x7fff'ffff),
                           std::int32_t, std::int64_t>>>;

/// A whole number from lo to hi. Whether the value is in range is checked
/// where it is encoded and decoded; until then it is a plain number.
template <std::int64_t lo, std::int64_t hi, growth g = growth::closed>
struct integer {
  // One that may grow takes values beyond its root range, within reason.
  using number =
      std::conditional_t<g == growth::closed, fitting<lo, hi>, std::int32_t>;
  static constexpr std::int64_t low = lo;
  static constexpr std::int64_t high = hi;
  static constexpr auto may_grow = g;
  static constexpr std::uint64_t span = static_cast<std::uint64_t>(hi - lo);
  static constexpr unsigned width = std::bit_width(span);

  number value = static_cast<number>(std::clamp<std::int64_t>(0, lo, hi));

  constexpr integer() = default;
  // NOLINTNEXTLINE(*-explicit-*): it is a number
  constexpr integer(number x) : value{x} {}
  // NOLINTNEXTLINE(*-explicit-*): it is a number
  constexpr operator number() const { return value; }
};

template <std::int64_t lo, std::int64_t hi>
using extensible_integer = integer<lo, hi, extensible>;

/// The names of an enumeration in ascending order of their ASN.1 values; the
/// enum counts them from 0. Specialise for every enum that is encoded.
template <std::size_t n, growth g = growth::closed>
struct enumeration {
  std::array<std::string_view, n> names;
  static constexpr std::size_t count = n;
  static constexpr auto may_grow = g;
};
template <class... Names>
consteval auto enumerated(Names... names) {
  return enumeration<sizeof...(Names)>{{names...}};
}
template <class... Names>
consteval auto enumerated_extensible(Names... names) {
  return enumeration<sizeof...(Names), extensible>{{names...}};
}
template <class Enum>
inline constexpr auto names_of = nullptr;

/// A fixed number of bits; bit 0, which goes first, is the highest.
template <unsigned n, growth g = growth::closed>
struct bit_string {
  static_assert(n <= 32);
  static constexpr auto may_grow = g;
  static constexpr unsigned width = n;
  static constexpr std::uint32_t all = 0xffff'ffff >> (32 - n);
  std::uint32_t bits = 0;

  static constexpr std::uint32_t mask(unsigned i) {
    return std::uint32_t{1} << (n - 1 - i);
  }
  constexpr bool test(unsigned i) const { return (bits & mask(i)) != 0; }
  constexpr void set(unsigned i) { bits |= mask(i); }
  friend bool operator==(const bit_string&, const bit_string&) = default;
};

/// A member that is not encoded when it has its default value.
template <class T, auto usual>
struct defaulted {
  T value{usual};
  constexpr bool is_usual() const { return value == T{usual}; }
};

/// One way out of several.
template <literal label, class T>
struct alternative {
  using type = T;
  static constexpr std::string_view name = label.view();
};
template <growth g, class... Alternatives>
struct basic_choice {
  static constexpr auto may_grow = g;
  static constexpr std::size_t count = sizeof...(Alternatives);
  static constexpr std::array<std::string_view, count> names{
      Alternatives::name...};
  template <std::size_t i>
  using type =
      std::variant_alternative_t<i,
                                 std::variant<typename Alternatives::type...>>;

  std::variant<typename Alternatives::type...> value;
};
template <class... Alternatives>
using choice = basic_choice<growth::closed, Alternatives...>;
template <class... Alternatives>
using extensible_choice = basic_choice<extensible, Alternatives...>;

/// Some of one kind. Short ones lie in place, so that decoding them needs no
/// heap.
template <class T, std::size_t least, std::size_t most,
          growth g = growth::closed>
struct sequence_of
    : std::conditional_t<
          std::is_trivially_copyable_v<T> && sizeof(T) * most <= longest_inline,
          inline_list<T, most>, std::vector<T>> {
  static constexpr std::size_t low = least;
  static constexpr std::size_t high = most;
  static constexpr auto may_grow = g;
};
template <class T, std::size_t least, std::size_t most>
using extensible_sequence_of = sequence_of<T, least, most, extensible>;

/// What is there but unknown to us, bit for bit.
struct opaque {
  std::vector<std::byte> octets;
  friend bool operator==(const opaque&, const opaque&) = default;
};

/// One of several types behind a length, so that who does not know it skips
/// it. Which one a number before it tells.
template <std::int64_t id, literal label, class T>
struct registered {
  using type = T;
  static constexpr std::int64_t number = id;
  static constexpr std::string_view name = label.view();
};
/// @tparam Id  The number's type.
template <class Id, class... Registered>
struct open_type {
  using id_type = Id;
  /// As WrappedCpmContainer, our only one, calls its two members.
  static constexpr std::string_view id_name = "containerId";
  static constexpr std::string_view value_name = "containerData";
  static constexpr std::size_t count = sizeof...(Registered);
  static constexpr std::array<std::int64_t, count> ids{Registered::number...};
  static constexpr std::array<std::string_view, count> names{
      Registered::name...};

  Id unknown_id{}; ///< Where the value is opaque.
  std::variant<typename Registered::type..., opaque> value;

  constexpr Id id() const {
    return value.index() < count
               ? Id(static_cast<typename Id::number>(ids[value.index()]))
               : unknown_id;
  }
};

// What is what.

template <class T>
inline constexpr bool is_integer = false;
template <std::int64_t lo, std::int64_t hi, growth g>
inline constexpr bool is_integer<integer<lo, hi, g>> = true;

template <class T>
inline constexpr bool is_bit_string = false;
template <unsigned n, growth g>
inline constexpr bool is_bit_string<bit_string<n, g>> = true;

template <class T>
inline constexpr bool is_choice = false;
template <growth g, class... As>
inline constexpr bool is_choice<basic_choice<g, As...>> = true;

template <class T>
inline constexpr bool is_sequence_of = false;
template <class T, std::size_t a, std::size_t b, growth g>
inline constexpr bool is_sequence_of<sequence_of<T, a, b, g>> = true;

template <class T>
inline constexpr bool is_open_type = false;
template <class Id, class... Rs>
inline constexpr bool is_open_type<open_type<Id, Rs...>> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_defaulted = false;
template <class T, auto usual>
inline constexpr bool is_defaulted<defaulted<T, usual>> = true;

/// A SEQUENCE may grow if it says so by `may_grow`.
template <class T>
constexpr bool sequence_may_grow() {
  if constexpr (requires { T::may_grow; })
    return T::may_grow == extensible;
  else
    return false;
}

} // namespace sofof::messages::etsi
