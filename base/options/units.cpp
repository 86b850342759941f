// Durations as people write them: "50ms", "1.5s", "30min", "2h".
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace sofof {

namespace {

struct unit {
  std::string_view name;
  std::int64_t ns;
};

/// Largest first.
constexpr std::array<unit, 6> units{{
    {"h", 3'600'000'000'000},
    {"min", 60'000'000'000},
    {"s", 1'000'000'000},
    {"ms", 1'000'000},
    {"us", 1'000},
    {"ns", 1},
}};

constexpr auto decimal_from = 2; // The units from here on are powers of ten.

std::optional<std::int64_t> find_unit(std::string_view name) {
  for (const auto& u : units)
    if (u.name == name)
      return u.ns;
  return std::nullopt;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Cuts the digits off the front of `text`.
std::string_view take_digits(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n]))
    ++n;
  const auto digits = text.substr(0, n);
  text.remove_prefix(n);
  return digits;
}

/// Adds `digit` · `weight` to `sum`; false when that is too much.
bool add(std::int64_t& sum, char digit, std::int64_t weight) {
  std::int64_t product = 0;
  return !__builtin_mul_overflow(digit - '0', weight, &product)
         && !__builtin_add_overflow(sum, product, &sum);
}

} // namespace

std::optional<duration> parse_duration(std::string_view text) {
  const auto negative = text.starts_with('-');
  text.remove_prefix(negative ? 1 : 0);
  const auto whole = take_digits(text);
  std::string_view fraction;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    fraction = take_digits(text);
    if (fraction.empty())
      return std::nullopt;
  }
  const auto unit = find_unit(text);
  if (whole.empty() || !unit)
    return std::nullopt;
  std::int64_t ns = 0;
  for (const auto digit : whole)
    if (__builtin_mul_overflow(ns, 10, &ns) || !add(ns, digit, *unit))
      return std::nullopt;
  auto weight = *unit;
  for (const auto digit : fraction) {
    if (digit != '0' && weight % 10 != 0)
      return std::nullopt;
    weight /= 10;
    if (!add(ns, digit, weight))
      return std::nullopt;
  }
  return duration{negative ? -ns : ns};
}

std::string print_duration(duration d) {
  // Unsigned, because the smallest duration has no positive counterpart.
  const auto negative = d < duration{0};
  const auto count = static_cast<std::uint64_t>(d.count());
  const auto ns = negative ? 0 - count : count;
  const auto sign = negative ? "-" : "";
  if (ns == 0)
    return "0s";
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto& [name, size] = units[i];
    const auto unit_ns = static_cast<std::uint64_t>(size);
    if (ns % unit_ns == 0)
      return fmt::format("{}{}{}", sign, ns / unit_ns, name);
    if (i < decimal_from || ns < unit_ns)
      continue;
    auto rest = fmt::format("{}", unit_ns + ns % unit_ns).substr(1);
    rest.erase(rest.find_last_not_of('0') + 1);
    return fmt::format("{}{}.{}{}", sign, ns / unit_ns, rest, name);
  }
  return {}; // Not reached: everything is a whole number of nanoseconds.
}

} // namespace sofof
