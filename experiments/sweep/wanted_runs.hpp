// From the points of a sweep to the runs that they want.
#pragma once

#include "experiments/sweep/plan.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments {

/// A run that one point of a sweep wants, or several.
struct wanted_run {
  std::string name; ///< See `run_store`.
  std::filesystem::path scenario;
  std::vector<std::string> given; ///< What changes the scenario.
  std::string point;              ///< The first that wants it, for people.
  double cost = 0;          ///< About proportional to its computing time, > 0.
  bool is_measured = false; ///< Its plan wants it from one machine.
  /// Why it is made anew each time, if it is.
  std::optional<std::string> unrepeatable{};
};

/// What became of the points of a sweep.
struct wanted_runs {
  std::vector<wanted_run> runs;      ///< Each once, in the order of the points.
  std::vector<std::string> run_of;   ///< Its name for each point; empty: none.
  std::vector<std::string> problems; ///< Of points without a run, a line each.
};

/// Loads the scenario of every point.
/// @param program      See `run_store`.
/// @param interrupted  Once true, it returns soon, with the first points.
/// @throws input_error when no point can be loaded, or one gives an option
///         twice.
wanted_runs runs_wanted_by(const sweep_plan& plan, std::string_view program,
                           const std::atomic<bool>& interrupted);

} // namespace sofof::experiments
