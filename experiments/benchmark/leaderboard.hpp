// Who does best: entrants in order, with the uncertainty of each figure.
#pragma once

#include "experiments/benchmark/criteria.hpp"
#include "experiments/benchmark/entrants.hpp"
#include "experiments/dehler2025/mean_interval.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::bench {

/// An entrant in one scenario, or in all together.
struct standing {
  std::string entrant;
  std::size_t runs = 0;
  std::size_t unsafe = 0; ///< Of these, those whose safety line did not hold.
  std::size_t failed = 0; ///< Runs without a result.
  /// Means over all runs; by names of criteria.
  std::map<std::string_view, study::interval> values;
  std::size_t seeds = 0; ///< Of one there is no interval.
  /// With the one above it: the interval of the difference of their scores, run
  /// by run, holds 0.
  bool tied = false;

  /// @returns whether it is ranked: it has done everything, and safely.
  bool above_line() const { return runs > 0 && unsafe + failed == 0; }
};

/// What the table of one scenario says, or that of all.
struct leaderboard {
  std::string scenario; ///< Empty: all together.
  /// By score, first those above the line, then those below it.
  std::vector<standing> standings;

  /// @returns those above the line, and those below it.
  std::span<const standing> above() const;
  std::span<const standing> below() const;
};

/// Runs that should be there.
struct expected_runs {
  std::vector<std::string> entrants;
  std::vector<std::string> scenarios;
  std::size_t seeds = 0;
};

/// @param runs      As far as they have a result.
/// @param scenario  Of which; empty: of all.
/// @returns figures of all runs of an entrant, with 95 % intervals over seeds
/// (`mean_interval`): what belongs to one seed, in whatever scenario, stays
/// together.
leaderboard rank(std::span<const judged_run> runs,
                 const expected_runs& expected, const std::string& scenario);

/// @returns whether an entrant offloads more than next to nothing, as far as it
/// is known. Who does not has no violations and no latencies, whatever it is
/// worth.
bool offloads(const standing& one);

/// @returns the best mean above the line, of those that offload unless it is
/// the score; nullptr if there is none, or if none is better than another by
/// this criterion.
const study::interval* best_of(const leaderboard& all, const criterion& by);

/// @param boards  One for each scenario, and one for all.
/// @returns a CSV file: a line for each entrant in each of them.
std::string to_csv(std::span<const leaderboard> boards,
                   std::span<const entrant> entrants);

} // namespace sofof::experiments::bench
