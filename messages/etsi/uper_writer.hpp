// Writing by the unaligned packed encoding rules.
// Source: ITU-T X.691.
#pragma once

#include "messages/etsi/bits.hpp"
#include "messages/etsi/packed.hpp"
#include "messages/etsi/schema.hpp"
#include "messages/etsi/uper_lengths.hpp"

#include <utility>

namespace sofof::messages::etsi {

template <class Out, class T>
void write(Out& out, const T& x);

template <class Out>
void write_length(Out& out, std::size_t octets) {
  if (octets < 0x80)
    out.put(octets, 8);
  else if (octets <= longest)
    out.put(octets | 0x8000, 16);
  else
    out.fail(fault::too_long, octets, 0, longest);
}

template <class Out, std::int64_t lo, std::int64_t hi, growth g>
void write_integer(Out& out, const integer<lo, hi, g>& x) {
  using type = integer<lo, hi, g>;
  const auto offset =
      static_cast<std::uint64_t>(x.value) - static_cast<std::uint64_t>(lo);
  const auto is_root = offset <= type::span;
  if constexpr (g == extensible) {
    out.put(!is_root, 1);
    if (!is_root) { // as an unconstrained number of 4 octets at most
      const auto value = static_cast<std::int64_t>(x.value);
      std::size_t octets = 1;
      while (octets < 4 && (value >> (8 * octets - 1) != value >> 63))
        ++octets;
      write_length(out, octets);
      const auto width = static_cast<unsigned>(8 * octets);
      out.put(static_cast<std::uint64_t>(value)
                  & ((std::uint64_t{1} << width) - 1),
              width);
      return;
    }
  } else if (!is_root) {
    out.fail(fault::out_of_range, x.value, lo, hi);
    out.put(0, type::width);
    return;
  }
  out.put(offset, type::width);
}

template <class Out>
void write_index(Out& out, std::size_t index, std::size_t count,
                 bool may_grow) {
  const auto is_root = index < count;
  if (may_grow)
    out.put(!is_root, 1);
  if (is_root)
    out.put(index, static_cast<unsigned>(std::bit_width(count - 1)));
  else if (may_grow && index - count < std::size_t{1} << small_width)
    out.put(index - count, small_width + 1); // a small one begins with 0
  else
    out.fail(fault::out_of_range, index, 0, count - 1);
}

/// Which optional members are there.
struct presence_writer {
  std::uint32_t bits = 0;
  unsigned width = 0;

  template <class T>
  void operator()(std::string_view, const T& x) {
    if constexpr (is_optional<T>)
      add(x.has_value());
    else if constexpr (is_defaulted<T>)
      add(!x.is_usual());
  }
  void add(bool is_there) {
    bits = bits << 1 | static_cast<std::uint32_t>(is_there);
    ++width;
  }
};

template <class Out>
struct member_writer {
  Out& out;

  template <class T>
  void operator()(std::string_view name, const T& x) {
    if constexpr (is_optional<T>) {
      if (x)
        (*this)(name, *x);
    } else if constexpr (is_defaulted<T>) {
      if (!x.is_usual())
        (*this)(name, x.value);
    } else {
      out.enter(name);
      write(out, x);
      out.leave();
    }
  }
};

template <class Out, growth g, class... As>
void write_choice(Out& out, const basic_choice<g, As...>& x) {
  using type = basic_choice<g, As...>;
  write_index(out, x.value.index(), type::count, g == extensible);
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    const auto write_one = [&](const auto& value) {
      out.enter(type::names[x.value.index()]);
      write(out, value);
      out.leave();
    };
    ((x.value.index() == i ? write_one(*std::get_if<i>(&x.value)) : void()),
     ...);
  }
  (std::index_sequence_for<As...>{});
}

template <class Out, class T, std::size_t a, std::size_t b, growth g>
void write_list(Out& out, const sequence_of<T, a, b, g>& xs) {
  const auto is_root = xs.size() >= a && xs.size() <= b;
  if (!is_root)
    return out.fail(fault::bad_count, xs.size(), a, b);
  if constexpr (g == extensible)
    out.put(0, 1);
  out.put(xs.size() - a, static_cast<unsigned>(std::bit_width(b - a)));
  std::size_t i = 0;
  for (const auto& x : xs) {
    out.enter(i++);
    write(out, x);
    out.leave();
  }
}

/// Writes as many octets as `x` needs, at least one.
/// @returns how many.
template <class Out, class T>
std::size_t write_octets(Out& out, const T& x) {
  const auto start = out.bits();
  write(out, x);
  const auto bits = out.bits() - start;
  const auto octets = std::max<std::size_t>(1, (bits + 7) / 8);
  out.put(0, static_cast<unsigned>(octets * 8 - bits));
  return octets;
}

/// The length is known afterwards: what is short is written again behind it,
/// into what is long it is put.
template <class Out, class T>
void write_behind_length(Out& out, const T& x) {
  const auto before = out;
  out.put(0, 16);
  const auto octets = write_octets(out, x);
  if (octets >= 0x80 && octets <= longest) {
    out.replace_16(before.bits(), static_cast<std::uint16_t>(octets | 0x8000));
    return;
  }
  out = before;
  write_length(out, octets);
  write_octets(out, x);
}

template <class Out, class T>
void write_open(Out& out, const T& x) {
  const auto write_inner = [&](const auto& inner) {
    write_behind_length(out, inner);
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((x.value.index() == i ? write_inner(*std::get_if<i>(&x.value)) : void()),
     ...);
  }
  (std::make_index_sequence<T::count>{});
  if (const auto* unknown = std::get_if<opaque>(&x.value)) {
    write_length(out, unknown->octets.size());
    for (auto octet : unknown->octets)
      out.put(std::to_integer<std::uint64_t>(octet), 8);
  }
}

template <class Out, class T>
void write(Out& out, const T& x) {
  if constexpr (std::is_same_v<T, bool>) {
    out.put(x, 1);
  } else if constexpr (is_integer<T>) {
    write_integer(out, x);
  } else if constexpr (std::is_enum_v<T>) {
    using names = std::remove_cvref_t<decltype(names_of<T>)>;
    write_index(out, static_cast<std::size_t>(x), names::count,
                names::may_grow == extensible);
  } else if constexpr (is_bit_string<T>) {
    if constexpr (T::may_grow == extensible)
      out.put(0, 1);
    if (x.bits > T::all)
      out.fail(fault::out_of_range, x.bits, 0, T::all);
    out.put(x.bits & T::all, T::width);
  } else if constexpr (is_choice<T>) {
    write_choice(out, x);
  } else if constexpr (is_sequence_of<T>) {
    write_list(out, x);
  } else if constexpr (is_open_type<T>) {
    write(out, x.id());
    write_open(out, x);
  } else if constexpr (is_packed<Out, T>) {
    write_packed(out, x);
  } else {
    presence_writer presence;
    T::fields(x, presence);
    // It has no additions: a leading zero.
    out.put(presence.bits, presence.width + sequence_may_grow<T>());
    T::fields(x, member_writer<Out>{out});
  }
}

} // namespace sofof::messages::etsi
