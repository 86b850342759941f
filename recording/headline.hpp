// A run in three sentences: how much was offloaded and why that ended, whether
// it was safe, and what was full.
#pragma once

#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <string>

namespace sofof::recording {

/// Each a sentence about the run; for the end of the console's table, the
/// summary and the head of a report.
struct headline {
  std::string offloading; ///< Of the service at the top of the summary.
  std::string safety;
  std::string load;
};

/// @param m  Finished, with its load.
headline headline_of(const metrics& m, const run_info& run, const run_end& end);

} // namespace sofof::recording
