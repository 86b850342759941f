// The results of a sweep as one table.
#pragma once

#include "experiments/sweep/plan.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sofof::experiments {

/// What is known of a point in the end.
struct point_result {
  std::string run;     ///< Its name below `runs`; empty if it has none.
  std::string summary; ///< The text of summary.json; empty if it failed.

  bool failed() const { return summary.empty(); }
  /// @returns whether the safety line held.
  bool safe() const;
};

/// How many runs ended how.
struct run_counts {
  std::size_t good = 0;
  std::size_t unsafe = 0; ///< Their own safety checks failed.
  std::size_t failed = 0; ///< There is no result.
  bool interrupted = false;

  void add(const point_result& result);
  std::size_t all() const { return good + unsafe + failed; }
  bool all_good() const { return unsafe + failed == 0; }
};

/// @param results  One for each of `points_of(plan)`.
/// @returns a CSV file: one line for each point, with the values of the axes,
/// and every figure of its summary that does not depend on the wall's clock,
/// under its path in it ("latency_ms.mean"). Columns: docs/sweeps.md.
std::string point_table(const sweep_plan& plan,
                        const std::vector<point_result>& results);

} // namespace sofof::experiments
