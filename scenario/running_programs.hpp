// The programs that decide in a run, as long as it lasts.
#pragma once

#include "scenario/build.hpp"
#include "scenario/scenario.hpp"

#include "programs/policy_program.hpp"
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sofof::scenario {

/// Which sides decide in this process.
struct deciding_sides {
  bool lodm = true;
  bool codm = true;
};

/// @returns those that the vehicles and providers of this process are on.
deciding_sides deciding_in(const scenario_definition& s,
                           const process_share& here);

/// Starts the programs that policies name, and ends them in time.
class running_programs {
public:
  /// @param s  Loaded; its policies become copies that ask the programs.
  /// @throws input_error when one cannot be started, programs::program_error
  ///         when it does not answer as it has to.
  explicit running_programs(scenario_definition& s, deciding_sides here = {});
  running_programs(const running_programs&) = delete;
  running_programs& operator=(const running_programs&) = delete;
  ~running_programs(); ///< As `end`.

  /// Calls `tell` with a sentence as soon as one of them fails, on any thread.
  void on_failure(const std::function<void(const std::string&)>& tell) const;

  bool have_failed() const;

  /// Ends them, and waits until they have gone.
  void end() const;

private:
  std::vector<std::shared_ptr<programs::policy_program>> all_;
};

/// @returns texts that are different where policies may decide differently for
/// the same configuration: of the files that they name, and what programs say
/// of their version. Programs are started for that, each once.
/// @throws as `running_programs`.
std::vector<std::string> keys_of_policies(const scenario_definition& s);

/// @returns a sentence on the program because of which a run has to be made
/// anew each time, as it tells no version; nullopt if there is none.
/// @throws as `running_programs`.
std::optional<std::string> unrepeatable_program(const scenario_definition& s);

} // namespace sofof::scenario
