// Reading by the unaligned packed encoding rules, whatever comes.
// Source: ITU-T X.691.
#pragma once

#include "messages/etsi/bits.hpp"
#include "messages/etsi/packed.hpp"
#include "messages/etsi/schema.hpp"
#include "messages/etsi/uper_lengths.hpp"

#include <utility>

namespace sofof::messages::etsi {

template <class In, class T>
void read(In& in, T& x);

template <class In>
std::size_t read_length(In& in) {
  if (in.get(1) == 0)
    return in.get(7);
  if (in.get(1) == 0)
    return in.get(14);
  in.fail(fault::too_long, 0, 0, longest);
  return 0;
}

/// @returns a small number; 64 or more is beyond all that is known.
template <class In>
std::size_t read_small(In& in) {
  if (in.get(1) == 0)
    return in.get(small_width);
  in.fail(fault::too_long, 0, 0, (1 << small_width) - 1);
  return 0;
}

template <class In, std::int64_t lo, std::int64_t hi, growth g>
void read_integer(In& in, integer<lo, hi, g>& x) {
  using type = integer<lo, hi, g>;
  using number = typename type::number;
  if constexpr (g == extensible) {
    if (in.get(1) == 1) {
      const auto octets = read_length(in);
      if (octets < 1 || octets > 4)
        return in.fail(fault::too_long, octets, 1, 4);
      const auto width = static_cast<unsigned>(8 * octets);
      const auto raw = in.get(width) << (64 - width);
      x.value =
          static_cast<number>(static_cast<std::int64_t>(raw) >> (64 - width));
      return;
    }
  }
  const auto offset = in.get(type::width);
  const auto value = static_cast<std::int64_t>(offset) + lo;
  if (offset > type::span)
    return in.fail(fault::out_of_range, value, lo, hi);
  x.value = static_cast<number>(value);
}

template <class In>
std::size_t read_index(In& in, std::size_t count, bool may_grow) {
  if (may_grow && in.get(1) == 1)
    return count + read_small(in);
  const auto index = in.get(static_cast<unsigned>(std::bit_width(count - 1)));
  if (index >= count)
    in.fail(fault::out_of_range, index, 0, count - 1);
  return index;
}

/// How many members need not be there.
struct presence_counter {
  unsigned count = 0;

  template <class T>
  void operator()(std::string_view, const T&) {
    count += is_optional<T> || is_defaulted<T>;
  }
};

template <class In>
struct member_reader {
  In& in;
  std::uint64_t presence; // of the members that need not be there
  unsigned left;

  template <class T>
  void operator()(std::string_view name, T& x) {
    if constexpr (is_optional<T>) {
      if (next())
        (*this)(name, x ? *x : x.emplace());
      else
        x.reset();
    } else if constexpr (is_defaulted<T>) {
      x = {};
      if (next())
        (*this)(name, x.value);
    } else {
      in.enter(name);
      read(in, x);
      in.leave();
    }
  }
  bool next() { return (presence >> --left & 1) != 0; }
};

template <class In>
void skip_octets(In& in, std::size_t octets) {
  if (octets * 8 > in.left())
    in.fail(fault::ends_early, octets * 8);
  else
    in.go_to(in.at() + octets * 8);
}

/// Skips additions of later versions. X.691, 19.7 to 19.9.
template <class In>
void skip_additions(In& in) {
  const auto count = read_small(in) + 1;
  const auto present =
      in.get(static_cast<unsigned>(std::min<std::size_t>(count, 64)));
  for (auto bits = present; bits != 0; bits &= bits - 1)
    skip_octets(in, read_length(in));
}

template <class In, class T>
void read_sequence(In& in, T& x) {
  presence_counter may_miss;
  T::fields(x, may_miss);
  const auto count = may_miss.count;
  const auto bits = in.get(count + sequence_may_grow<T>());
  T::fields(x, member_reader<In>{in, bits, count});
  if (bits >> count != 0)
    skip_additions(in);
}

template <class In, growth g, class... As>
void read_choice(In& in, basic_choice<g, As...>& x) {
  using type = basic_choice<g, As...>;
  const auto index = read_index(in, type::count, g == extensible);
  if (index >= type::count)
    return in.fail(fault::unknown_choice, index, 0, type::count - 1);
  const auto read_one = [&]<std::size_t i>() {
    if (index != i)
      return;
    in.enter(type::names[i]);
    auto* value = std::get_if<i>(&x.value);
    read(in, value ? *value : x.value.template emplace<i>());
    in.leave();
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (read_one.template operator()<i>(), ...);
  }
  (std::index_sequence_for<As...>{});
}

template <class In, class T, std::size_t a, std::size_t b, growth g>
void read_list(In& in, sequence_of<T, a, b, g>& xs) {
  if constexpr (g == extensible)
    if (in.get(1) == 1)
      return in.fail(fault::bad_count, read_length(in), a, b);
  const auto count = in.get(static_cast<unsigned>(std::bit_width(b - a))) + a;
  if (count > b)
    return in.fail(fault::bad_count, count, a, b);
  xs.resize(count);
  for (std::size_t i = 0; i < count && in.ok(); ++i) {
    in.enter(i);
    read(in, xs[i]);
    in.leave();
  }
}

template <class In>
void read_opaque(In& in, opaque& x) {
  x.octets.resize(in.left() / 8);
  for (auto& octet : x.octets)
    octet = static_cast<std::byte>(in.get(8));
}

template <class In, class T>
void read_open(In& in, T& x) {
  typename T::id_type id;
  read(in, id);
  const auto octets = read_length(in);
  if (octets * 8 > in.left())
    return in.fail(fault::ends_early, octets * 8);
  const auto behind = in.at() + octets * 8;
  const auto end = in.end_at(behind);
  const auto read_one = [&]<std::size_t i>() {
    if (id.value != T::ids[i])
      return false;
    auto* value = std::get_if<i>(&x.value);
    in.enter(T::names[i]);
    read(in, value ? *value : x.value.template emplace<i>());
    in.leave();
    return true;
  };
  const auto is_known = [&]<std::size_t... i>(std::index_sequence<i...>) {
    return (read_one.template operator()<i>() || ...);
  }
  (std::make_index_sequence<T::count>{});
  if (!is_known) {
    x.unknown_id = id;
    read_opaque(in, x.value.template emplace<opaque>());
  }
  in.end_at(end);
  if (in.ok())
    in.go_to(behind);
}

template <class In, class T>
void read(In& in, T& x) {
  if constexpr (std::is_same_v<T, bool>) {
    x = in.get(1) == 1;
  } else if constexpr (is_integer<T>) {
    read_integer(in, x);
  } else if constexpr (std::is_enum_v<T>) {
    using names = std::remove_cvref_t<decltype(names_of<T>)>;
    x = static_cast<T>(
        read_index(in, names::count, names::may_grow == extensible));
  } else if constexpr (is_bit_string<T>) {
    if constexpr (T::may_grow == extensible)
      if (in.get(1) == 1)
        return in.fail(fault::bad_count, read_length(in), T::width, T::width);
    x.bits = static_cast<std::uint32_t>(in.get(T::width));
  } else if constexpr (is_choice<T>) {
    read_choice(in, x);
  } else if constexpr (is_sequence_of<T>) {
    read_list(in, x);
  } else if constexpr (is_open_type<T>) {
    read_open(in, x);
  } else if constexpr (is_packed<In, T>) {
    read_packed(in, x);
  } else {
    read_sequence(in, x);
  }
}

} // namespace sofof::messages::etsi
