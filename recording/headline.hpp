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
  /// several.
  std::string offloading;
  std::string safety;
  std::string load;
};

/// @param x  Of a service that was never offloaded.
/// @returns why, as far as counts tell: "no offer came."
std::string why_never(const service_metrics& x, std::uint64_t offers);

/// @param m  Finished, with its load.
headline headline_of(const metrics& m, const run_info& run, const run_end& end);

} // namespace sofof::recording
