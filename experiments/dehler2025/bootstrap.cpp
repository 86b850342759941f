// Percentile intervals of a ratio of sums.
#include "experiments/dehler2025/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sofof::experiments::study {

namespace {

constexpr std::size_t resamples = 2000;

std::optional<double> mean_of(group all) {
  return all.count > 0 ? std::optional{all.sum / all.count} : std::nullopt;
}

} // namespace

std::optional<interval> bootstrap(std::span<const group> groups,
                                  const random_stream& noise) {
  group all;
  for (const auto& g : groups) {
    all.sum += g.sum;
    all.count += g.count;
  }
  const auto mean = mean_of(all);
  if (!mean)
    return std::nullopt;
  std::vector<double> means;
  for (std::size_t k = 0; k < resamples; ++k) {
    group drawn;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto u = noise.uniform(k * groups.size() + i);
      const auto& g = groups[static_cast<std::size_t>(
          u * static_cast<double>(groups.size()))];
      drawn.sum += g.sum;
      drawn.count += g.count;
    }
    if (const auto again = mean_of(drawn)) // all drawn groups may be empty
      means.push_back(*again);
  }
  std::ranges::sort(means);
  const auto place = [&means](double share) {
    return means[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(means.size() - 1)))];
  };
  return interval{*mean, place(outside_each_side),
                  place(1 - outside_each_side)};
}

} // namespace sofof::experiments::study
