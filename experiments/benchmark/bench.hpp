// Every policy in every scenario, on the same noise, in order.
#pragma once

#include "experiments/benchmark/entrants.hpp"
#include "experiments/sweep/sharded_sweep.hpp"

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments::bench {

struct bench_options {
  std::vector<std::filesystem::path> scenarios; ///< At least one.
  std::vector<entrant> entrants;                ///< At least one.
  std::vector<std::string> set;                 ///< "KEY=VALUE", in all runs.
  std::size_t seeds = 1;                        ///< From 1 on, >= 1.
  sweep_options
      runs; ///< How and where; `out` gets everything, `title` is ours.
  bool colour = false; ///< The console is a terminal.
};

/// What became of it.
struct bench_outcome {
  bool interrupted = false;
  bool all_good = false; ///< All runs have a result, and were safe.
};

/// @returns a sweep for each scenario: what `bench` runs. Its first seed is
/// measured: decision times.
/// @throws input_error when options cannot be ranked.
std::vector<sweep_plan> plans_of(const bench_options& options);

/// Makes the runs of one shard, for `bench` to find. Decision times count of
/// those that `options.runs.make` times.
/// @throws input_error as `make_shard`, and for a folder of something else.
shard_outcome bench_shard(const bench_options& options, const shard& which,
                          const std::atomic<bool>& interrupted,
                          std::ostream& console);

/// Makes all runs that have not been made before, and writes leaderboard.csv,
/// timing.csv, report.html and a table of runs for each scenario. Killed at any
/// moment, the same call goes on.
/// @param console  Gets the progress, what failed, and the leaderboard.
/// @throws input_error when a file is missing or wrong, or results cannot be
///         kept.
bench_outcome bench(const bench_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console);

} // namespace sofof::experiments::bench
