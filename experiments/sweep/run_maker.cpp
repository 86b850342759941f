// Runs in virtual time.
#include "experiments/sweep/run_maker.hpp"

#include "scenario/run.hpp"

#include <ostream>
#include <utility>

namespace sofof::experiments {

run_maker virtual_runs(std::string version, bool time_decisions) {
  scenario::run_options how;
  how.version = std::move(version);
  how.time_decisions = time_decisions;
  return [how](const scenario::scenario_definition& s,
               const std::filesystem::path& folder,
               const std::atomic<bool>& interrupted) {
    std::ostream nowhere{nullptr};
    auto here = how;
    here.out = folder;
    scenario::run(s, here, interrupted, nowhere);
  };
}

} // namespace sofof::experiments
