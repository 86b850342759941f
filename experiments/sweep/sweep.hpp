// Runs everything that a sweep asks for, and keeps what came out.
#pragma once

#include "experiments/sweep/make_runs.hpp"
#include "experiments/sweep/plan.hpp"
#include "experiments/sweep/point_table.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments {

struct sweep_options : making {
  std::filesystem::path out; ///< Gets NAME.csv and the folder `runs`.
  std::string program;       ///< See `run_store`.
};

/// What became of the points of a sweep.
struct sweep_outcome : run_counts {
  std::filesystem::path table; ///< Written unless interrupted.
  /// The results folder of each of `points_of(plan)`; empty where it failed.
  std::vector<std::filesystem::path> folders;
};

/// Runs what has not been run before: killed at any moment, the same call goes
/// on. A point that fails is reported and does not stop the others.
/// @param interrupted  Once true, it ends soon; what is finished is kept.
/// @param console      Gets the progress and what failed.
/// @throws input_error when results cannot be kept, or no point can be loaded.
sweep_outcome sweep(const sweep_plan& plan, const sweep_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console);

} // namespace sofof::experiments
