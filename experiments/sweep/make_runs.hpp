// Many runs on several threads, and how far they are.
#pragma once

#include "experiments/sweep/run_maker.hpp"
#include "experiments/sweep/run_store.hpp"
#include "experiments/sweep/wanted_runs.hpp"
#include "recording/progress.hpp"

#include <atomic>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments {

/// How far they are, for whoever watches from another thread.
struct making_progress {
  std::atomic<std::size_t> runs = 0;  ///< All that are wanted.
  std::atomic<std::size_t> found = 0; ///< That were there before.
  std::atomic<std::size_t> good = 0, unsafe = 0, failed = 0; ///< Made by now.
};

/// How runs are made.
struct making {
  run_maker make;
  unsigned jobs = 1; ///< Runs at the same time, >= 1.
  recording::progress::output show = recording::progress::output::quiet;
  std::string title;                  ///< In front of the progress.
  making_progress* watched = nullptr; ///< Kept up to date, unless null.
};

/// Makes those that the store does not have, the longest first, so that the
/// last ones to end are short. One that fails is reported and does not stop the
/// others.
/// @param interrupted  Once true, it ends soon; what is finished is kept.
/// @param console      Gets the progress and what failed.
/// @returns how many the store had before.
std::size_t make_runs(std::vector<wanted_run> runs, const run_store& store,
                      const making& how, const std::atomic<bool>& interrupted,
                      std::ostream& console);

} // namespace sofof::experiments
