// One shard of the runs of one or several sweeps.
#pragma once

#include "experiments/sweep/shard.hpp"
#include "experiments/sweep/sweep.hpp"

#include <atomic>
#include <cstddef>
#include <iosfwd>
#include <span>
#include <string_view>

namespace sofof::experiments {

/// What became of the runs of a shard.
struct shard_outcome : run_counts {
  std::size_t of_all = 0; ///< Runs of all shards.
  std::size_t found = 0;  ///< Its own that were there before.
};

/// Makes what is missing of a shard's runs, and writes no table: `sweep` finds
/// the runs. Shards of the same plans, and the sweeps themselves, may be at
/// work in one folder at the same time. Points that cannot be loaded are
/// reported by the first shard, and count as its failures.
/// @param plans        All shards are given the same.
/// @param interrupted  Once true, it ends soon; what is finished is kept.
/// @param console      Gets the progress and what failed.
/// @throws input_error when runs cannot be kept, or a plan has no point that
///         can be loaded.
shard_outcome make_shard(std::span<const sweep_plan> plans,
                         const sweep_options& options, const shard& which,
                         const std::atomic<bool>& interrupted,
                         std::ostream& console);

/// @returns how many runs there are to share out.
/// @param program  See `run_store`.
/// @throws input_error when a plan has no point that can be loaded.
std::size_t count_runs(std::span<const sweep_plan> plans,
                       std::string_view program,
                       const std::atomic<bool>& interrupted);

} // namespace sofof::experiments
