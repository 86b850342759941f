// Runs in virtual time.
#include "scenario/sweep/run_maker.hpp"

#include "scenario/run.hpp"

#include <ostream>
#include <utility>

namespace sofof {

run_maker virtual_runs(std::string version) {
  run_options options;
  options.force = true;
  options.version = std::move(version);
  return [options](const scenario& s, const std::filesystem::path& folder,
                   const std::atomic<bool>& interrupted) {
    auto here = options;
    here.out = folder;
    std::ostream nowhere{nullptr};
    run(s, here, interrupted, nowhere);
  };
}

} // namespace sofof
