// What it means that two runs have different figures.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>
#include <string>
#include <string_view>

namespace sofof::experiments::report {

/// How a figure depends on how long its run was.
enum class figure_nature {
  total,   ///< Grows with it.
  extreme, ///< Of the longer run it is rather farther out.
  mean,    ///< A mean, quantile or share: not at all.
};

/// @param member  Of summary.json, below `services.NAME` without that.
figure_nature nature_of(std::string_view member);

/// Two runs' figures against each other.
class comparison {
public:
  /// @param runs  Two.
  explicit comparison(std::span<const recorded_run> runs);

  /// @returns whether one was longer by more than a hundredth: then totals are
  /// compared per minute, and extremes not at all.
  bool unlike_lengths() const { return unlike_; }

  /// @param member    As above.
  /// @param first     Scaled as shown; likewise `second`.
  /// @param decimals  As shown.
  /// @returns second minus first, with its sign; "0", or a dash where that
  /// would say nothing.
  std::string difference(std::string_view member, double first, double second,
                         int decimals) const;

  /// @returns whether either lost results: what comes after an early end is in
  /// no figure of results, so that one that ends more looks better.
  bool cuts_off() const { return cuts_off_; }

  /// @returns whether the second is better, where less or more of something is,
  /// and the difference is more than a hundredth; `different` where it would be
  /// so of what was cut off.
  table::verdict verdict(std::string_view member, double first,
                         double second) const;

private:
  double of_first(std::string_view member, double x) const;
  double of_second(std::string_view member, double x) const;

  double first_min_, second_min_; // lengths
  bool unlike_;
  bool cuts_off_; // an episode, in either
};

/// @returns a table of the options in which runs differ, without a row if they
/// do not, and what else a reader must know before comparing.
section what_differs(std::span<const recorded_run> runs);

/// @returns the same in a few words: "max_latency 30 → 50 ms"; empty if
/// nothing.
std::string difference_in_short(const table& options);

} // namespace sofof::experiments::report
