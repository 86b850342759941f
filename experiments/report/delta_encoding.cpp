// Differences, bits, Base64.
#include "experiments/report/delta_encoding.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::report {

namespace {

constexpr std::size_t block_size = 64;
constexpr double largest = 1 << 28; // second differences fit into 31 bits
constexpr int digits = 7;
constexpr int most_places = 18;
constexpr int most_order = 2;

double largest_of(std::span<const double> values) {
  double most = 0;
  for (const auto x : values)
    if (std::isfinite(x))
      most = std::max(most, std::abs(x));
  return most;
}

std::uint32_t without_sign(std::int64_t x) {
  return static_cast<std::uint32_t>(x < 0 ? -2 * x - 1 : 2 * x);
}

std::vector<std::int64_t> differences(std::vector<std::int64_t> of) {
  for (auto i = of.size(); i-- > 1;)
    of[i] -= of[i - 1];
  return of;
}

std::string in_blocks(std::span<const std::int64_t> values) {
  std::string bytes;
  for (std::size_t i = 0; i < values.size(); i += block_size) {
    const auto block =
        values.subspan(i, std::min(block_size, values.size() - i));
    std::uint32_t all = 0;
    for (const auto x : block)
      all |= without_sign(x);
    const auto width = static_cast<int>(std::bit_width(all));
    bytes += static_cast<char>(width);
    std::uint64_t pending = 0;
    int bits = 0;
    for (const auto x : block) {
      pending |= std::uint64_t{without_sign(x)} << bits;
      for (bits += width; bits >= 8; bits -= 8, pending >>= 8)
        bytes += static_cast<char>(pending & 0xff);
    }
    if (bits > 0)
      bytes += static_cast<char>(pending);
  }
  return bytes;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "abcdefghijklmnopqrstuvwxyz"
                                       "0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      three = three << 8
              | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6)
      text += letters[three >> shift & 63];
  }
  const auto missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

} // namespace

nlohmann::json delta_encoding(std::span<const double> values, int places) {
  const auto most = largest_of(values);
  while (most * std::pow(10, places) > largest)
    --places;
  const auto scale = std::pow(10, places);
  std::vector<std::int64_t> column;
  column.reserve(values.size());
  auto gaps = nlohmann::json::array();
  for (const auto x : values) {
    if (std::isfinite(x)) {
      column.push_back(std::llround(x * scale));
    } else {
      gaps.push_back(column.size());
      column.push_back(column.empty() ? 0 : column.back());
    }
  }
  auto bytes = in_blocks(column);
  auto best = 0;
  for (int order = 1; order <= most_order; ++order) {
    column = differences(std::move(column));
    auto shorter = in_blocks(column);
    if (shorter.size() >= bytes.size())
      continue;
    bytes = std::move(shorter);
    best = order;
  }
  nlohmann::json all{values.size(), places, best, base64(bytes)};
  if (!gaps.empty())
    all.push_back(std::move(gaps));
  return all;
}

nlohmann::json delta_encoding(std::span<const double> values) {
  const auto most = largest_of(values);
  const auto before_point =
      most > 0 ? static_cast<int>(std::ceil(std::log10(most))) : digits;
  return delta_encoding(values, std::min(digits - before_point, most_places));
}

} // namespace sofof::report
