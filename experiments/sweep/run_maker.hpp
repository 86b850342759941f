// What makes one run of a sweep.
#pragma once

#include "scenario/scenario.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

namespace sofof::experiments {

/// Makes one run, on the thread that calls. Its results are in the folder, a
/// new one, when it returns; what it throws says why there are none. Several
/// threads call it at the same time.
/// @param interrupted  Once true, it returns soon, with what there is.
using run_maker = std::function<void(const scenario::scenario_definition& s,
                                     const std::filesystem::path& folder,
                                     const std::atomic<bool>& interrupted)>;

/// @param version         Of this program, for the summaries.
/// @param time_decisions  As `run_options` has it.
/// @returns what makes runs in virtual time.
run_maker virtual_runs(std::string version, bool time_decisions = true);

} // namespace sofof::experiments
