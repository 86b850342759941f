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
  double p50_us = 0; ///< The median of its runs' quantiles, and so is p99.
  double p99_us = 0;
  double max_us = 0;
};

/// Reads timing.csv of all runs. A side that never decided has no line.
/// @throws input_error when a file is missing or broken.
std::vector<decision_cost> read_decision_costs(std::span<const timed_runs> all);

/// @param scenario  Empty: the slowest of all.
/// @returns the p99 of the slower side, us; nullopt if neither has decided.
std::optional<double> slowest_p99_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario);

/// @returns a CSV file.
std::string to_csv(std::span<const decision_cost> costs);

} // namespace sofof::experiments::bench
