// Where the runs of sweeps lie: each under a name that its configuration
// makes, so that no run is made twice.
#pragma once

#include "scenario/scenario.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace sofof {

/// The results folders below one folder. One process at a time has it.
class run_store {
public:
  /// Makes the folder where it is missing.
  /// @param program  Tells programs apart whose results may differ.
  /// @throws input_error when it cannot be made, or another process has it.
  run_store(std::filesystem::path folder, std::string program);

  run_store(const run_store&) = delete;
  run_store& operator=(const run_store&) = delete;
  ~run_store();

  /// @returns the name of the run of this scenario: the same for the same
  /// configuration, map, trace and program.
  std::string name_of(const scenario& s) const;

  std::filesystem::path folder_of(const std::string& name) const;

  /// @returns the summary of a run that came to its planned end; nullopt for
  /// one that is missing, was killed or was interrupted.
  std::optional<std::string> summary_of(const std::string& name) const;

private:
  std::filesystem::path folder_;
  std::string program_;
  int lock_ = -1;
};

} // namespace sofof
