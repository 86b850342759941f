// Whole numbers, and their differences.
#include "experiments/report/delta_encoding.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

constexpr double largest = 1 << 28; // enough for seven digits, and exact
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

std::vector<std::int64_t> differences(std::vector<std::int64_t> of) {
  for (auto i = of.size(); i-- > 1;)
    of[i] -= of[i - 1];
  return of;
}

// About as many bits as they take when they are compressed.
std::uint64_t size_of(std::span<const std::int64_t> values) {
  std::uint64_t bits = 0;
  for (const auto x : values)
    bits += std::bit_width(static_cast<std::uint64_t>(std::abs(x)));
  return bits;
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
  auto best = 0;
  auto shortest = column;
  for (int order = 1; order <= most_order; ++order) {
    column = differences(std::move(column));
    if (size_of(column) >= size_of(shortest))
      continue;
    shortest = column;
    best = order;
  }
  auto all = nlohmann::json::array({places, best, std::move(shortest)});
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

} // namespace sofof::experiments::report
