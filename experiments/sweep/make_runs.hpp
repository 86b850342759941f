// Many runs on several threads, and how far they are.
#pragma once

#include "experiments/sweep/run_maker.hpp"
#include "experiments/sweep/run_store.hpp"
#include "experiments/sweep/wanted_runs.hpp"
#include "recording/progress.hpp"

#include <atomic>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments {

/// How runs are made.
struct making {
  run_maker make;
  unsigned jobs = 1; ///< Runs at the same time, >= 1.
  recording::progress::output show = recording::progress::output::quiet;
  std::string title; ///< In front of the progress.
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
