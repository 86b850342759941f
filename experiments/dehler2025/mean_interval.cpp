// Percentiles of weighted ratios of sums.
#include "experiments/dehler2025/mean_interval.hpp"

#include "base/random.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace sofof::experiments::study {

namespace {

double mean_value(const group& g) {
  return g.sum / g.count;
}

/// @returns the group with the lowest mean, or the highest.
group extreme(std::span<const group> groups, const std::optional<group>& unseen,
              bool lowest) {
  std::optional<group> found = unseen;
  for (const auto& g : groups)
    if (g.count > 0
        && (!found
            || (lowest ? mean_value(g) < mean_value(*found)
                       : mean_value(g) > mean_value(*found))))
      found = g;
  return found.value();
}

double percentile(std::vector<double>& values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(
      std::lround(share * static_cast<double>(values.size() - 1)));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<std::size_t>(place)];
}

} // namespace

group_weights::group_weights(std::size_t most_groups, std::size_t resamples)
    : columns_{most_groups + 1}, resamples_{resamples} {
  assert(resamples >= 1);
  constexpr std::uint64_t seed = 1, longest_row = 1U << 20U;
  assert(columns_ <= longest_row);
  const random_stream noise{seed, "group_weights"};
  weights_.reserve(columns_ * resamples_);
  for (std::uint64_t k = 0; k < resamples_; ++k)
    for (std::uint64_t i = 0; i < columns_; ++i)
      weights_.push_back(noise.exponential(1, k * longest_row + i));
}

std::span<const double> group_weights::row(std::size_t resample,
                                           std::size_t groups) const {
  assert(resample < resamples_ && groups < columns_);
  return std::span{weights_}.subspan(resample * columns_, groups + 1);
}

std::optional<interval> mean_interval(std::span<const group> groups,
                                      const unseen_groups& unseen,
                                      const group_weights& weights) {
  group all;
  for (const auto& g : groups) {
    all.sum += g.sum;
    all.count += g.count;
  }
  if (!(all.count > 0))
    return std::nullopt;
  const auto lowest = extreme(groups, unseen.lowest, true);
  const auto highest = extreme(groups, unseen.highest, false);
  std::vector<double> lows, highs;
  for (std::size_t k = 0; k < weights.resamples(); ++k) {
    const auto w = weights.row(k, groups.size());
    group drawn;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      drawn.sum += w[i + 1] * groups[i].sum;
      drawn.count += w[i + 1] * groups[i].count;
    }
    const auto with = [&](const group& more) {
      return (drawn.sum + w[0] * more.sum) / (drawn.count + w[0] * more.count);
    };
    lows.push_back(with(lowest));
    highs.push_back(with(highest));
  }
  return interval{mean_value(all), percentile(lows, outside_each_side),
                  percentile(highs, 1 - outside_each_side)};
}

std::optional<interval> mean_interval(std::span<const group> groups,
                                      const unseen_groups& unseen) {
  constexpr std::size_t often = 64; // rows of more groups are made anew
  if (groups.size() > often)
    return mean_interval(groups, unseen, group_weights{groups.size()});
  static const group_weights common{often};
  return mean_interval(groups, unseen, common);
}

} // namespace sofof::experiments::study
