// A results folder, opened: what was run, and what its summary says.
#pragma once

#include "experiments/report/run_files.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::report {

struct recorded_run {
  std::filesystem::path folder;
  std::string label; ///< What a reader knows it by: the folder's name.
  scenario::scenario_definition what; ///< From config.toml.
  std::string config_toml;
  /// What summary.json says, by dotted names ("latency_ms.mean"), without
  /// what is null; nothing when the run was killed before it wrote any.
  std::optional<std::map<std::string, double>> figures;
  std::string version; ///< Of the program that ran it; empty if killed.
  std::string clock;   ///< "virtual" or "wall"; empty if killed.
  bool interrupted = false;
  std::vector<std::string> headline; ///< The run in sentences, if it has any.
  std::vector<episode_line> episodes;
  /// Nothing when the run was told not to write them.
  std::optional<std::vector<cycle_line>> cycles;

  /// @returns a figure of the summary; nothing if it has none of that name.
  std::optional<double> figure(const std::string& name) const;

  /// @returns the place of a provider in the configuration, if it is there.
  std::optional<std::size_t> place_of(const std::string& provider) const;
};

/// @returns the text of its config.toml.
/// @throws input_error when it is no results folder.
std::string config_of(const std::filesystem::path& folder);

/// @throws input_error when it is no results folder, or broken.
recorded_run open_run(const std::filesystem::path& folder);

/// The same for several; folders of the same name are known by their path.
/// @throws input_error also when one is named twice.
std::vector<recorded_run>
open_runs(std::span<const std::filesystem::path> folders);

/// @returns the names of all services that these runs know, in their order.
std::vector<std::string> services_of(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
