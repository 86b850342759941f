// How long entrants took to decide, by the wall's clock.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::bench {

/// Where the runs of an entrant in a scenario lie.
struct timed_runs {
  std::string entrant;
  std::string scenario;
  std::vector<std::filesystem::path> folders;
};

/// What one side of an entrant took in one scenario, all runs together.
struct decision_cost {
  std::string entrant;
  std::string scenario;
  std::string side; ///< "lodm" or "codm".
  double decisions = 0;
  double mean_us = 0;
  double p50_us = 0; ///< The median of its runs' medians.
  /// The least of its runs' quantiles: others on the machine add to a time and
  /// take nothing away. Nothing if no run has decisions enough for one.
  std::optional<double> p99_us;
  double max_us = 0;
};

/// Reads timing.csv of all runs. A side that never decided has no line.
/// @throws input_error when a file is missing or broken.
std::vector<decision_cost> read_decision_costs(std::span<const timed_runs> all);

/// A run's 99 % quantile of fewer decisions says nothing of the other 1 %.
inline constexpr double fewest_for_p99 = 1000;

/// @param scenario  Empty: the slowest of all.
/// @returns the median of the slower side, us; nullopt if neither has decided.
std::optional<double> slowest_p50_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario);

/// The same of the 99 % quantile; nullopt also if neither has one.
std::optional<double> slowest_p99_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario);

/// @returns a CSV file.
std::string to_csv(std::span<const decision_cost> costs);

} // namespace sofof::experiments::bench
