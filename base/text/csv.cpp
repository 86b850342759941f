// Numbers and texts as they stand in tables.
#include "base/text/csv.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>

namespace sofof {

namespace {

constexpr auto powers_of_ten = [] {
  std::array<double, 10> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i)
    powers[i] = powers[i - 1] * 10;
  return powers;
}();

} // namespace

decimal rounded(std::optional<double> x, int places) {
  assert(places >= 0 && places < static_cast<int>(powers_of_ten.size()));
  constexpr auto limit = 9.2e18; // below the largest integer of 64 bits
  const auto scaled =
      x.value_or(NAN) * powers_of_ten[static_cast<std::size_t>(places)];
  if (!(std::abs(scaled) < limit))
    return {std::nullopt, places};
  return {std::llround(scaled), places};
}

void append(std::string& out, decimal x) {
  assert(x.places >= 0 && x.places <= 18);
  if (!x.digits)
    return;
  constexpr std::size_t room = 24; // sign, 19 digits, point
  std::array<char, room> text;
  auto at = room;
  const auto negative = *x.digits < 0;
  auto rest = static_cast<std::uint64_t>(*x.digits);
  if (negative)
    rest = 0 - rest;
  for (int i = 0; i < x.places; ++i, rest /= 10)
    text[--at] = static_cast<char>('0' + rest % 10);
  if (x.places > 0)
    text[--at] = '.';
  do {
    text[--at] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest > 0);
  if (negative)
    text[--at] = '-';
  out.append(text.data() + at, room - at);
}

void append(std::string& out, std::uint64_t x) {
  const fmt::format_int text{x};
  out.append(text.data(), text.size());
}

void append(std::string& out, std::string_view x) {
  if (x.find_first_of(",\"\r\n") == x.npos) {
    out += x;
    return;
  }
  out += '"';
  for (const auto c : x)
    out.append(c == '"' ? 2 : 1, c);
  out += '"';
}

} // namespace sofof
