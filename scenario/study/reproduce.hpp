// The paper's evaluation from beginning to end.
#pragma once

#include "scenario/progress.hpp"
#include "scenario/sweep/run_maker.hpp"

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace sofof::study {

struct reproduction_options {
  std::filesystem::path sweeps; ///< The folder of the paper's sweep files.
  std::filesystem::path out;    ///< Gets everything.
  std::string program;          ///< See `run_store`.
  std::string version;
  progress::output show = progress::output::quiet;
  run_maker make;
  unsigned jobs = 1; ///< Runs at the same time, >= 1.
};

/// Makes all runs that have not been made before, and writes report.html and
/// reproduction.md. Killed at any moment, the same call goes on.
/// @returns whether it came to its end: not if it was interrupted.
/// @throws input_error when a file is missing or wrong, or results cannot be
///         kept; std::runtime_error when a run fails or is unsafe.
bool reproduce(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console);

} // namespace sofof::study
