// Runs everything that a sweep asks for, and keeps what came out.
#pragma once

#include "scenario/progress.hpp"
#include "scenario/sweep/plan.hpp"
#include "scenario/sweep/run_maker.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof {

struct sweep_options {
  std::filesystem::path out; ///< Gets NAME.csv and the folder `runs`.
  std::string program;       ///< See `run_store`.
  progress::output show = progress::output::quiet;
  std::string title; ///< In front of the progress.
  run_maker make;
  unsigned jobs = 1; ///< Runs at the same time, >= 1.
};

/// What became of the points of a sweep.
struct sweep_outcome {
  std::size_t good = 0;
  std::size_t unsafe = 0; ///< Their own safety checks failed.
  std::size_t failed = 0; ///< There is no result.
  bool interrupted = false;
  std::filesystem::path table; ///< Written unless interrupted.
  /// The results folder of each of `points_of(plan)`; empty where it failed.
  std::vector<std::filesystem::path> folders;

  bool all_good() const { return unsafe + failed == 0; }
};

/// Runs what has not been run before: killed at any moment, the same call goes
/// on. A point that fails is reported and does not stop the others.
/// @param interrupted  Once true, it ends soon; what is finished is kept.
/// @param console      Gets the progress and what failed.
/// @throws input_error when results cannot be kept, or no point can be loaded.
sweep_outcome sweep(const sweep_plan& plan, const sweep_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console);

} // namespace sofof
