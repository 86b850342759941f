// Octets as tests write them.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test {

using octets = std::vector<std::byte>;

/// @param digits  An even number of hexadecimal digits.
inline octets from_hex(std::string_view digits) {
  octets result;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    result.push_back(static_cast<std::byte>(
        std::stoi(std::string{digits.substr(i, 2)}, nullptr, 16)));
  return result;
}

inline std::string to_hex(const octets& x) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (auto octet : x) {
    result += digits[std::to_integer<std::size_t>(octet >> 4)];
    result += digits[std::to_integer<std::size_t>(octet & std::byte{15})];
  }
  return result;
}

/// '0' and '1' to octets; the last one is filled with zeros.
inline octets from_bits(std::string_view bits) {
  octets result((bits.size() + 7) / 8);
  for (std::size_t i = 0; i < bits.size(); ++i)
    if (bits[i] == '1')
      result[i / 8] |= std::byte{0x80} >> i % 8;
  return result;
}

inline std::string to_bits(const octets& x) {
  std::string result;
  for (std::size_t i = 0; i < 8 * x.size(); ++i)
    result += (x[i / 8] & std::byte{0x80} >> i % 8) != std::byte{0} ? '1' : '0';
  return result;
}

/// @returns one message a line; empty if there is no such file.
inline std::vector<octets> read_hex_file(const std::string& path) {
  std::vector<octets> result;
  std::ifstream file{path};
  for (std::string line; file >> line;)
    result.push_back(from_hex(line));
  return result;
}

} // namespace sofof::test
