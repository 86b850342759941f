// How long offloadings last, and how sure that is.
#pragma once

#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/measured_run.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::experiments::study {

/// Offloadings of trajectory planning in one run.
struct run_episodes {
  double t_off_s = 0; ///< Of all that count, together.
  double count = 0;   ///< See `measured_run::t_off_s`.
  double early = 0;   ///< Of them, those that a violation ended.
  double hours = 0;   ///< Of all vehicles together in which they offload.

  /// Each early end is followed by another episode in the same pass.
  double passes() const { return count - early; }
};

/// The mean of t_off, s. As long as early ends are rare (fewer than passes) and
/// fewer than three runs have one, one run more is thought of that has one in
/// each pass, so that the interval is none of a world without them; likewise
/// one without any, as long as fewer than three runs have none. The number
/// three is ours; tests/experiments/interval_coverage.cpp shows what it gives.
/// @returns nullopt without an episode.
std::optional<interval> mean_t_off(std::span<const run_episodes> runs);

/// The same for one who asks whether more runs are needed: both runs are
/// thought of as long as early ends are rare, however many were seen, so that
/// runs do not stop where chance makes them look alike.
std::optional<interval> cautious_t_off(std::span<const run_episodes> runs);

/// Early ends per hour of offloading, which the end of a run does not bias,
/// whatever it cuts off. Runs are thought of as by `mean_t_off`.
/// @returns nullopt when nothing was offloaded.
std::optional<interval> early_ends_per_hour(std::span<const run_episodes> runs);

/// @throws input_error when a run's summary lacks a figure.
std::vector<run_episodes>
episodes_of(std::span<const measured_run* const> runs);

std::optional<interval> mean_t_off(std::span<const measured_run* const> runs);
std::optional<interval>
early_ends_per_hour(std::span<const measured_run* const> runs);

/// @returns the seeds of runs with an early end, ascending.
std::vector<std::int64_t>
seeds_with_early_ends(std::span<const measured_run* const> runs);

/// When a point of a study has enough runs. Both numbers are ours.
struct seed_rule {
  double narrow_s = 3;   ///< Half of its interval of t_off, at most.
  std::size_t times = 1; ///< How many times `most_seeds` it may have.
};

/// The rule of `--full`.
inline constexpr seed_rule full_rule{1, 10};

/// @returns whether the interval, seen with caution, is not narrow yet.
bool needs_more_runs(std::span<const run_episodes> runs, const seed_rule& rule);

/// @param have  How many runs a point has, >= 1; `runs` may be fewer, where
///              some say nothing.
/// @param most  That it may have.
/// @returns how many it shall have next: twice as many, or as many as it has.
std::size_t runs_wanted(std::size_t have, std::size_t most,
                        std::span<const run_episodes> runs,
                        const seed_rule& rule);

} // namespace sofof::experiments::study
