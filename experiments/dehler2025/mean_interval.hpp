// Means with their uncertainty.
#pragma once

#include "experiments/dehler2025/interval.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::experiments::study {

/// Groups as they could be among those that were not drawn: the mean may be as
/// low or as high as they let it.
struct unseen_groups {
  std::optional<group> lowest;
  std::optional<group> highest;
};

/// Random weights of groups, the same for all that use them.
class group_weights {
public:
  /// @param most_groups  That an interval may be made of.
  /// @param resamples    How often weights are drawn, >= 1.
  explicit group_weights(std::size_t most_groups, std::size_t resamples = 2000);

  std::size_t resamples() const { return resamples_; }

  /// @returns a row of exponentially distributed weights, one for each group
  /// and one more, which comes first.
  /// @param groups  <= most_groups.
  std::span<const double> row(std::size_t resample, std::size_t groups) const;

private:
  std::size_t columns_;
  std::size_t resamples_;
  std::vector<double> weights_;
};

/// The mean of all values of all groups, not of the groups' means, and its
/// interval. Groups are independent of each other, values of one group may
/// depend on each other. Each end of the interval is a percentile of weighted
/// means, where weights are uniform on all sets of weights, and one group more
/// is weighed than there is: for the lower end the lowest of all groups, or the
/// `unseen` one if that is lower, for the upper end the highest. Of groups with
/// two possible values, both of them weighed, it is the exact interval of a
/// share (`share_interval`); so it does not become a point when what is rare
/// was not seen.
/// @returns nullopt without values. Of a single group the interval is its mean,
/// unless something else is unseen.
/// Source: Gaffke, Three test statistics for a nonparametric one-sided
/// hypothesis on the mean of a nonnegative variable, Math. Methods Statist.
/// 14(4), 2005; Learned-Miller & Thomas, A new confidence interval for the mean
/// of a bounded random variable, arXiv 1905.06208, 2019. The percentiles are
/// drawn, as in Rubin, The Bayesian bootstrap, Ann. Statist. 9(1), 1981.
std::optional<interval> mean_interval(std::span<const group> groups,
                                      const unseen_groups& unseen,
                                      const group_weights& weights);

/// The same with weights of its own.
std::optional<interval> mean_interval(std::span<const group> groups,
                                      const unseen_groups& unseen = {});

} // namespace sofof::experiments::study
