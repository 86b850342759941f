// Where the runs of sweeps lie: each under a name that its configuration
// makes, so that no run is made twice.
#pragma once

#include "experiments/sweep/work_folder.hpp"
#include "scenario/scenario.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::experiments {

/// @param program  Tells programs apart whose results may differ.
/// @returns the name of the run of this scenario: the same for the same
/// configuration, map, trace, program, and programs that decide; new in each
/// process where one of these tells no version.
/// @throws as `scenario::keys_of_policies`.
std::string name_of_run(const scenario::scenario_definition& s,
                        std::string_view program);

/// The results folders below one folder, which any number of processes may
/// share, on several machines. A run is made beside them, in runs/.unfinished,
/// and appears whole, by one rename. All members may be called by any thread.
class run_store {
public:
  /// Makes the folder where it is missing, and removes what processes of this
  /// machine left unfinished when they were killed.
  /// @throws input_error when it cannot be made.
  explicit run_store(std::filesystem::path folder);

  std::filesystem::path folder_of(const std::string& name) const;

  /// @returns the summary of a run that came to its planned end; nullopt for
  /// one that is missing or was interrupted.
  std::optional<std::string> summary_of(const std::string& name) const;

  /// Adds a run if it comes to its planned end, unless another process has
  /// added it meanwhile. Nothing is left of one that does not.
  /// @param make  Makes the run in the folder that it gets, a new one.
  /// @throws what `make` throws; input_error when the run cannot be kept.
  void add(const std::string& name,
           const std::function<void(const std::filesystem::path& there)>& make)
      const;

private:
  void publish(const std::filesystem::path& run, const std::string& name) const;

  std::filesystem::path folder_;
  std::unique_ptr<work_folder> own_;
  mutable std::atomic<int> begun_ = 0;
};

} // namespace sofof::experiments
