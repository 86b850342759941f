// Runs on the thread that asks.
#include "scenario/run.hpp"
#include "scenario/sweep/run_site.hpp"

#include <ostream>

namespace sofof {

void own_site::carry_out(const scenario& s, const std::filesystem::path& folder,
                         const std::atomic<bool>& interrupted) {
  run_options options;
  options.out = folder;
  options.force = true;
  options.version = version_;
  std::ostream nowhere{nullptr};
  run(s, options, interrupted, nowhere);
}

} // namespace sofof
