// Bits one after the other, highest first, without regard to octets.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

namespace sofof::messages::etsi {

/// What can be wrong with a message.
enum class fault : std::uint8_t {
  none,
  ends_early,   ///< More bits are needed than there are.
  no_room,      ///< The buffer to encode into is too small.
  out_of_range, ///< A number beyond what its type allows.
  unknown_choice,
  bad_count, ///< A list is too short or too long.
  too_long,  ///< A length that no message of ours has.
  leftover,  ///< More follows than the zero bits that fill the last octet.
};

/// Writes bits into a buffer. Once something does not fit or is wrong, `bad()`
/// says so for good.
class bit_writer {
public:
  explicit bit_writer(std::span<std::byte> out)
      : at_{out.data()}, end_{out.data() + out.size()}, begin_{out.data()} {}

  /// @param width  At most 64; `value` has no higher bits.
  void put(std::uint64_t value, unsigned width) {
    assert(width <= word);
    const auto holds = holds_ + width;
    if (holds < word) {
      held_ = held_ << width | value;
      holds_ = holds;
      return;
    }
    const auto over = holds - word; // bits wait for the next word
    store(held_ << 1 << (word - 1 - holds_) | value >> over);
    held_ = value;
    holds_ = over;
  }

  void fail(fault what, const auto&...) {
    if (fault_ == fault::none)
      fault_ = what;
  }
  fault bad() const { return fault_; }

  /// @returns how many were put, also those for which there was no room.
  std::size_t bits() const {
    return static_cast<std::size_t>(at_ - begin_) * 8 + holds_ + lost_;
  }

  /// Puts 16 bits in the place of others.
  /// @param bit  Where they are; a word or more has been put behind them.
  void replace_16(std::size_t bit, std::uint16_t value) {
    auto* const octet = begin_ + bit / 8;
    if (fault_ != fault::none || at_ - octet < 3)
      return; // no room
    const auto shift = 8 - static_cast<unsigned>(bit % 8);
    for (int i = 0; i < 3; ++i) {
      const auto from = 8 * (2 - i);
      const auto mask = std::uint32_t{0xffff} << shift >> from & 0xff;
      const auto bits = std::uint32_t{value} << shift >> from & 0xff;
      octet[i] = (octet[i] & ~std::byte(mask)) | std::byte(bits);
    }
  }

  /// Fills the last octet with zero bits.
  /// @returns how many octets were written; 0 when something was wrong.
  std::size_t finish() {
    while (holds_ > 0) {
      if (at_ == end_) {
        fail(fault::no_room);
        break;
      }
      const auto octet =
          holds_ >= 8 ? held_ >> (holds_ - 8) : held_ << (8 - holds_);
      *at_++ = static_cast<std::byte>(octet & 0xff);
      holds_ -= holds_ >= 8 ? 8 : holds_;
    }
    return fault_ == fault::none ? static_cast<std::size_t>(at_ - begin_) : 0;
  }

  // For those who want to know where something is wrong.
  void enter(const auto&) {}
  void leave() {}

private:
  static constexpr unsigned word = 64;

  void store(std::uint64_t bits) {
    if (end_ - at_ < 8) {
      lost_ += word;
      return fail(fault::no_room);
    }
    bits = __builtin_bswap64(bits);
    std::memcpy(at_, &bits, 8);
    at_ += 8;
  }

  std::uint64_t held_ = 0; // the lowest `holds_` bits wait
  unsigned holds_ = 0;     // less than a word between two calls
  std::size_t lost_ = 0;
  fault fault_ = fault::none;
  std::byte* at_;
  std::byte* end_;
  std::byte* begin_;
};

/// Counts what a `bit_writer` would write.
class bit_counter {
public:
  void put(std::uint64_t, unsigned width) { bits_ += width; }
  void fail(fault, const auto&...) {}
  void replace_16(std::size_t, std::uint16_t) {}
  std::size_t bits() const { return bits_; }
  void enter(const auto&) {}
  void leave() {}

private:
  std::size_t bits_ = 0;
};

/// Reads bits; beyond the end, zeros, and `bad()` says so for good.
class bit_reader {
public:
  explicit bit_reader(std::span<const std::byte> in)
      : in_{in.data()}, octets_{in.size()}, end_{in.size() * 8} {}

  /// Inline always: most widths are constants.
  /// @param width  At most 64.
  [[gnu::always_inline]] std::uint64_t get(unsigned width) {
    assert(width <= 64);
    if (width > at_once)
      return get_long(width);
    if (width > end_ - at_) {
      fail(fault::ends_early);
      at_ = end_;
      return 0;
    }
    if (width == 0)
      return 0;
    const auto value = word(at_ / 8) << at_ % 8 >> (64 - width);
    at_ += width;
    return value;
  }

  void fail(fault what, const auto&...) {
    if (fault_ == fault::none)
      fault_ = what;
  }
  fault bad() const { return fault_; }
  bool ok() const { return fault_ == fault::none; }

  std::size_t at() const { return at_; }
  std::size_t left() const { return end_ - at_; }

  /// Reads on elsewhere. Precondition: not beyond the end.
  void go_to(std::size_t bit) {
    assert(bit <= end_);
    at_ = bit;
  }
  /// Moves the end. @returns where it was.
  std::size_t end_at(std::size_t bit) { return std::exchange(end_, bit); }

  void enter(const auto&) {}
  void leave() {}

private:
  /// What is left of a word that does not begin with an octet.
  static constexpr unsigned at_once = 57;

  [[gnu::noinline]] std::uint64_t get_long(unsigned width) {
    const auto high = get(width - 32);
    return high << 32 | get(32);
  }

  // The 64 bits from an octet on, zeros beyond the end.
  std::uint64_t word(std::size_t octet) const {
    if (octets_ - octet < 8)
      return last_word(octet);
    std::uint64_t bits = 0;
    std::memcpy(&bits, in_ + octet, 8);
    return __builtin_bswap64(bits);
  }
  [[gnu::noinline]] std::uint64_t last_word(std::size_t octet) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 8; ++i)
      bits = bits << 8
             | (octet + i < octets_
                    ? std::to_integer<std::uint64_t>(in_[octet + i])
                    : 0);
    return bits;
  }

  const std::byte* in_;
  std::size_t octets_;
  std::size_t end_; // in bits
  std::size_t at_ = 0;
  fault fault_ = fault::none;
};

} // namespace sofof::messages::etsi
