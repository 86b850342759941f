// Equal parts of the same runs, each for a process of its own.
#pragma once

#include "experiments/sweep/wanted_runs.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::experiments {

/// One part of several.
struct shard {
  std::size_t number = 1; ///< From 1 to `of`.
  std::size_t of = 1;     ///< How many there are, at most `most_shards`.
};

/// No sweep has more runs.
inline constexpr std::size_t most_shards = most_sweep_points;

/// The shard that makes all that is measured by the wall's clock, so that it is
/// measured on one machine.
inline constexpr std::size_t measuring_shard = 1;

/// @param text  "I/N" with 1 <= I <= N <= `most_shards`; or "K+1/N", where I is
///              K + 1: who starts shards may count them from 0.
/// @returns nullopt for any other text.
std::optional<shard> parse_shard(std::string_view text);

/// Shares runs out: those that are measured to the measuring shard; then all
/// others, the longest first, each to the shard that has least to do so far.
/// The same runs in the same order are always shared out alike, so processes
/// that know nothing of each other agree. Where nothing is measured, no shard
/// has more to do than 4/3 of what the best distribution would give it.
/// Source: Graham, Bounds on Multiprocessing Timing Anomalies, SIAM J. Appl.
/// Math. 17(2), 1969 ("longest processing time").
/// @param shards  >= 1.
/// @returns the number of each run's shard.
std::vector<std::size_t> share_out(std::span<const wanted_run> runs,
                                   std::size_t shards);

} // namespace sofof::experiments
