// The unaligned packed encoding rules for the types of schema.hpp.
// Source: ITU-T X.691.
#pragma once

#include "messages/etsi/bits.hpp"
#include "messages/etsi/packed.hpp"
#include "messages/etsi/schema.hpp"

#include <utility>

namespace sofof::etsi {

// -- encoding ---------------------------------------------------------------

template <class Out, class T>
void write(Out& out, const T& x);

/// A small number of no fixed range: an index beyond the root, a count of
/// additions. X.691, 11.6.
inline constexpr unsigned small_width = 6;

/// The length of an open type or of an extended number in octets, unfragmented.
/// X.691, 11.9.
inline constexpr std::size_t longest = 0x3fff;

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

// -- decoding ---------------------------------------------------------------

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

// -- whole messages ---------------------------------------------------------

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

} // namespace sofof::etsi
