// Where the runs of sweeps lie: each under a name that its configuration
// makes, so that no run is made twice.
#pragma once

#include "scenario/scenario.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// @param program  Tells programs apart whose results may differ.
/// @returns the name of the run of this scenario: the same for the same
/// configuration, map, trace and program.
std::string name_of_run(const scenario& s, std::string_view program);

/// The results folders below one folder. One process at a time has it.
class run_store {
public:
  /// Makes the folder where it is missing.
  /// @throws input_error when it cannot be made, or another process has it.
  explicit run_store(std::filesystem::path folder);

  run_store(const run_store&) = delete;
  run_store& operator=(const run_store&) = delete;
  ~run_store();

  std::filesystem::path folder_of(const std::string& name) const;

  /// @returns the summary of a run that came to its planned end; nullopt for
  /// one that is missing, was killed or was interrupted.
  std::optional<std::string> summary_of(const std::string& name) const;

private:
  std::filesystem::path folder_;
  int lock_ = -1;
};

} // namespace sofof
