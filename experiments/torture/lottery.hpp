// Draws one after the other, for whoever makes something up.
#pragma once

#include "base/random.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace sofof::experiments::torture {

/// Draws of one stream in turn. What is drawn for one part of a scenario does
/// not shift what another part draws, as each has a lottery of its own.
class lottery {
public:
  explicit lottery(random_stream stream) : stream_{stream} {}

  /// @returns a lottery for a part of what this one is for.
  lottery part(std::string_view name) const {
    return lottery{stream_.part(name)};
  }
  lottery part(std::uint64_t number) const {
    return lottery{stream_.part(number)};
  }

  bool happens(double probability) {
    return stream_.uniform(next_++) < probability;
  }

  /// @param digits  Decimals: scenarios are read by people.
  double number(double low, double high, int digits) {
    const auto scale = std::pow(10.0, digits);
    return std::round(stream_.uniform(low, high, next_++) * scale) / scale;
  }

  /// @returns a number with as many below its geometric mean as above; for
  /// what may be small or large, as probabilities of loss.
  /// @param low  > 0.
  double spread(double low, double high, int digits) {
    const auto scale = std::pow(10.0, digits);
    const auto x =
        std::exp(stream_.uniform(std::log(low), std::log(high), next_++));
    return std::round(x * scale) / scale;
  }

  /// @returns a whole number of both ends or between them.
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    assert(low <= high);
    const auto room = static_cast<double>(high - low + 1);
    return low + static_cast<std::int64_t>(room * stream_.uniform(next_++));
  }

  /// @returns one of them, by their weights.
  template <class T>
  const T& one_of(std::span<const std::pair<T, double>> all) {
    double sum = 0;
    for (const auto& [what, weight] : all)
      sum += weight;
    auto left = sum * stream_.uniform(next_++);
    for (const auto& [what, weight] : all) {
      left -= weight;
      if (left < 0)
        return what;
    }
    return all.back().first;
  }

private:
  random_stream stream_;
  std::uint64_t next_ = 0;
};

} // namespace sofof::experiments::torture
