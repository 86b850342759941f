// Two digits an octet.
#include "messages/etsi/hex.hpp"

namespace sofof::messages::etsi {

namespace {

constexpr std::string_view digits = "0123456789abcdef";
constexpr std::string_view capitals = "0123456789ABCDEF";
constexpr std::string_view white = " \t\r\n\v\f";

} // namespace

void append_hex(std::string& out, std::span<const std::byte> octets) {
  for (const auto octet : octets) {
    const auto value = std::to_integer<std::size_t>(octet);
    out += digits[value >> 4];
    out += digits[value & 0xf];
  }
}

std::optional<std::vector<std::byte>> octets_from_hex(std::string_view text) {
  const auto begin = text.find_first_not_of(white);
  text.remove_prefix(begin == text.npos ? text.size() : begin);
  if (text.starts_with("0x") || text.starts_with("0X"))
    text.remove_prefix(2);
  std::vector<std::byte> octets;
  octets.reserve(text.size() / 2);
  auto is_half = false;
  for (const auto c : text) {
    if (white.find(c) != white.npos)
      continue;
    auto value = digits.find(c);
    if (value == digits.npos)
      value = capitals.find(c);
    if (value == capitals.npos)
      return {};
    if (is_half)
      octets.back() |= static_cast<std::byte>(value);
    else
      octets.push_back(static_cast<std::byte>(value << 4));
    is_half = !is_half;
  }
  if (is_half)
    return {};
  return octets;
}

} // namespace sofof::messages::etsi
