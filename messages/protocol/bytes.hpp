// Plain bytes for what services exchange: little-endian, no padding.
#pragma once

#include "base/fields.hpp"
#include "base/strong_id.hpp"
#include "base/time.hpp"

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sofof::messages {

static_assert(std::endian::native == std::endian::little,
              "bytes are written as they lie in memory");

/// Takes values one after the other as plain bytes; a struct field by field
/// (base/fields.hpp).
/// @tparam Sink  Has `append(const std::byte* from, std::size_t size)`.
template <class Sink>
class byte_output {
public:
  template <class... Ts>
  void operator()(const Ts&... xs) {
    (write(xs), ...);
  }

protected:
  Sink sink_;

private:
  template <class T>
  void write(const T& x) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      sink_.append(reinterpret_cast<const std::byte*>(&x), sizeof(T));
    } else {
      auto each = [this](std::string_view, auto& field) { write(field); };
      // The list serves both directions, hence takes a mutable reference.
      visit_fields(each, const_cast<T&>(x));
    }
  }
  template <class Tag, class Rep>
  void write(const strong_id<Tag, Rep>& id) {
    write(id.value());
  }
  void write(const duration& d) { write(d.count()); }
  void write(const time_point& t) { write(t.time_since_epoch()); }
  template <class T>
  void write(const std::optional<T>& x) {
    write(x.has_value());
    if (x)
      write(*x);
  }
  template <class T>
  void write(const std::vector<T>& xs) {
    write(static_cast<std::uint32_t>(xs.size()));
    if constexpr (std::is_same_v<T, std::byte>) {
      sink_.append(xs.data(), xs.size());
    } else {
      for (const auto& x : xs)
        write(x);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size()));
    for (auto c : text)
      write(c);
  }
};

/// Keeps bytes.
struct byte_buffer_sink {
  std::vector<std::byte> bytes;
  void append(const std::byte* from, std::size_t size) {
    bytes.insert(bytes.end(), from, from + size);
  }
};

/// Counts bytes.
struct byte_count_sink {
  std::size_t count = 0;
  void append(const std::byte*, std::size_t size) { count += size; }
};

/// Writes values.
class byte_writer : public byte_output<byte_buffer_sink> {
public:
  std::vector<std::byte> take() { return std::move(sink_.bytes); }
};

/// Tells how many bytes `byte_writer` would write.
class byte_counter : public byte_output<byte_count_sink> {
public:
  std::size_t count() const { return sink_.count; }
};

/// Reads what `byte_writer` wrote. Bytes from a stranger are no danger: once
/// something does not fit, `ok()` is false and everything reads as zero.
class byte_reader {
public:
  explicit byte_reader(std::span<const std::byte> in) : in_{in} {}

  template <class... Ts>
  void operator()(Ts&... xs) {
    (read(xs), ...);
  }

  /// @returns whether all reads so far fitted.
  bool ok() const { return ok_; }
  /// @returns whether everything was read, and fitted.
  bool done() const { return ok_ && in_.empty(); }

private:
  template <class T>
  void read(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      read(byte);
      ok_ = ok_ && byte <= 1;
      x = ok_ && byte == 1;
    } else if constexpr (has_last<T>) {
      std::underlying_type_t<T> number{};
      read(number);
      ok_ = ok_ && number >= 0 && static_cast<T>(number) <= last_of(T{});
      x = ok_ ? static_cast<T>(number) : T{};
    } else if constexpr (std::is_arithmetic_v<
                             T> || std::is_same_v<T, std::byte>) {
      x = T{};
      if (!fits(sizeof(T)))
        return;
      std::memcpy(&x, in_.data(), sizeof(T));
      in_ = in_.subspan(sizeof(T));
    } else {
      auto each = [this](std::string_view, auto& field) { read(field); };
      visit_fields(each, x);
    }
  }
  template <class Tag, class Rep>
  void read(strong_id<Tag, Rep>& id) {
    Rep number = 0;
    read(number);
    id = number;
  }
  void read(duration& d) {
    duration::rep count = 0;
    read(count);
    d = duration{count};
  }
  void read(time_point& t) {
    duration since{};
    read(since);
    t = time_point{since};
    ok_ = ok_ && is_plausible(t);
  }
  template <class T>
  void read(std::optional<T>& x) {
    bool present = false;
    read(present);
    x.reset();
    if (present)
      read(x.emplace());
  }
  template <class T>
  void read(std::vector<T>& xs) {
    std::uint32_t size = 0;
    read(size);
    xs.clear();
    if (!fits(size)) // every element takes a byte or more
      return;
    if constexpr (std::is_same_v<T, std::byte>) {
      xs.assign(in_.begin(), in_.begin() + size);
      in_ = in_.subspan(size);
    } else {
      for (std::uint32_t i = 0; i < size && ok_; ++i)
        read(xs.emplace_back());
    }
  }
  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    text.clear();
    if (!fits(size))
      return;
    text.resize(size);
    std::memcpy(text.data(), in_.data(), size);
    in_ = in_.subspan(size);
  }
  bool fits(std::size_t size) {
    ok_ = ok_ && size <= in_.size();
    return ok_;
  }

  std::span<const std::byte> in_;
  bool ok_ = true;
};

} // namespace sofof::messages
