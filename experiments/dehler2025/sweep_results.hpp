// A sweep's table, read again.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"
#include "experiments/sweep/sweep.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sofof::experiments::study {

/// What a sweep has left: its axes by name, and its runs.
struct sweep_results {
  std::string name;
  std::vector<std::string> axes;
  std::vector<measured_run> runs; ///< Those that did not fail.
  std::size_t failed = 0;
  std::size_t unsafe = 0;
};

/// @param outcome  Of this plan, at its end.
/// @returns the runs of all points that did not fail, in their order.
/// @throws input_error when a file is missing or broken.
std::vector<measured_run> runs_of(const sweep_plan& plan,
                                  const sweep_outcome& outcome);

/// @returns whether a file begins as such a table does.
bool is_sweep_table(const std::filesystem::path& file);

/// @param table  NAME.csv, beside the folder `runs`.
/// @throws input_error when it is no such table, or a run is missing.
sweep_results read_swept(const std::filesystem::path& table);

} // namespace sofof::experiments::study
