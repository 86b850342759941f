// The paper's evaluation from beginning to end.
#pragma once

#include "experiments/sweep/sharded_sweep.hpp"

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments::study {

struct reproduction_options {
  std::filesystem::path sweeps; ///< The folder of the paper's sweep files.
  std::string version;
  /// How and where; `out` gets everything, `title` is ours.
  sweep_options runs;
  bool full = false; ///< Narrow intervals, which take hours.
  /// A latency trace for all runs in virtual time, in place of their channels;
  /// empty: none. docs/channels.md says what it holds.
  std::filesystem::path trace;
};

/// @returns the paper's sweeps: what `reproduce` runs next. Where it adds seeds
///          (`seed_rounds`), those of the round after what has been made.
/// @throws input_error when a file is missing or wrong.
std::vector<sweep_plan> next_plans(const reproduction_options& options,
                                   const std::atomic<bool>& interrupted);

/// Makes the runs of one shard, for `reproduce` to find: those of the round
/// that is next when it begins, so that the shards of a round are started
/// together, and again as long as there is a round. The measuring shard makes
/// those on the wall's clock as well, after all others.
/// @throws as `reproduce`, and as `make_shard`.
shard_outcome reproduce_shard(const reproduction_options& options,
                              const shard& which,
                              const std::atomic<bool>& interrupted,
                              std::ostream& console);

/// Makes all runs that have not been made before, and writes report.html and
/// reproduction.md. Killed at any moment, the same call goes on.
/// @returns whether it came to its end: not if it was interrupted.
/// @throws input_error when a file is missing or wrong, or results cannot be
///         kept; std::runtime_error when a run fails or is unsafe.
bool reproduce(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console);

} // namespace sofof::experiments::study
