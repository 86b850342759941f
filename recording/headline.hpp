// A run in three sentences: how much was offloaded and why that ended, whether
// it was safe, and what was full.
#pragma once

#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <string>

namespace sofof::recording {

/// Each a sentence about the run; for the end of the console's table, the
/// summary and the head of a report.
struct headline {
  /// Of the service at the top of the summary, by its name where there are
  /// several; then of each other one that was never offloaded or ended early.
  std::string offloading;
  std::string safety;
  std::string load;
};

/// @param x  Of a service that was never offloaded.
/// @returns why, as far as counts tell: "nobody offered it."
std::string why_never(const service_metrics& x);

/// @returns how long, and until when, the machine kept the watch of stalls
/// waiting (scenario/stall_watch.hpp); empty if it is not worth a word.
std::string lateness_of(const standstill& x);

/// @param m  Finished, with its load.
headline headline_of(const metrics& m, const run_info& run, const run_end& end);

} // namespace sofof::recording
