// Runs on the wall's clock that tell what computing costs.
#pragma once

#include "experiments/dehler2025/sections.hpp"
#include "experiments/sweep/run_store.hpp"

#include <atomic>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::study {

/// Which run: config/paper/cpu.toml, changed.
struct cpu_run {
  std::string name; ///< Its folder's begins so.
  std::filesystem::path scenario;
  std::vector<std::string> given; ///< "KEY=VALUE".
  std::string program;            ///< See `run_store`.
  std::string version;            ///< For its summary.
};

/// Makes the run, unless the store has it, which takes as long as its scenario
/// lasts. Nothing else should compute meanwhile.
/// @returns its folder; there is none yet if it was interrupted.
/// @throws input_error; std::runtime_error when it was unsafe, as it is on a
///         busy machine.
std::filesystem::path make_cpu_run(const cpu_run& which, const run_store& store,
                                   const std::atomic<bool>& interrupted);

/// @param folders  Of such runs, at least one.
/// @throws input_error when a file is missing or broken; std::runtime_error
///         when no vehicle of a run was both local and offloaded.
measured_cpu read_cpu_runs(std::span<const std::filesystem::path> folders);

} // namespace sofof::experiments::study
