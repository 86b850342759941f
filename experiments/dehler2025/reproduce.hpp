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
};

/// @returns the paper's sweeps: what `reproduce` runs.
/// @throws input_error when a file is missing or wrong.
std::vector<sweep_plan> plans_of(const reproduction_options& options);

/// Makes the runs of one shard, for `reproduce` to find. The measuring shard
/// makes those on the wall's clock as well, after all others.
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
