// Tables as text: comma-separated, fixed decimals, the same bytes everywhere.
#pragma once

#include "base/files/output_file.hpp"
#include "base/time.hpp"

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// A number with a fixed count of decimals, held exactly; nullopt is an
/// empty field.
struct decimal {
  std::optional<std::int64_t> digits; ///< The number · 10^places.
  int places = 0;                     ///< 0 … 18.
};

/// Seconds, exact to the nanosecond.
constexpr decimal seconds(duration d) {
  return {d.count(), 9};
}

/// Milliseconds, exact to the nanosecond; nullopt is an empty field.
constexpr decimal milliseconds(std::optional<duration> d) {
  return {d ? std::optional{d->count()} : std::nullopt, 6};
}

/// @param places  0 … 9.
/// @returns x rounded; an empty field when x is not finite, absent, or too
/// large for an integer of 64 bits.
decimal rounded(std::optional<double> x, int places);

/// Appends a number as text, "-0.050" for {-50, 3}; nothing when absent.
void append(std::string& out, decimal x);
void append(std::string& out, std::uint64_t x);
/// Appends a text, in quotes where it needs them (RFC 4180).
void append(std::string& out, std::string_view x);

/// A CSV file, row by row.
class csv_file {
public:
  /// @param header  Names of the columns, separated by commas.
  csv_file(std::filesystem::path path, std::string_view header);

  /// Writes a row; the fields are decimals, texts, or unsigned integers
  /// (a bool is 1 or 0).
  template <class First, class... Rest>
  void row(const First& first, const Rest&... rest) {
    auto& out = file_.text();
    put(out, first);
    ((out += ',', put(out, rest)), ...);
    out += '\n';
    file_.end_line();
  }

  void flush() { file_.flush(); }
  void close() { file_.close(); }

private:
  template <class T>
  static void put(std::string& out, const T& x) {
    if constexpr (std::unsigned_integral<T>)
      append(out, std::uint64_t{x});
    else
      append(out, x);
  }

  output_file file_;
};

} // namespace sofof
