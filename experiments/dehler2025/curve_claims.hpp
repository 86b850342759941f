// What the paper says of its latency plot, asked of ours.
#pragma once

#include "experiments/dehler2025/sections.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sofof::experiments::study {

/// A curve rises at the shortest limit, ms, at which it has half of its height:
/// the mean offloading time at the longest limit.
struct curve_claims {
  /// All curves rise beyond the planning period, and have heights.
  bool rise_late = false;
  /// The height of one vehicle's is the time in the area, a tenth more or less.
  bool saturates = false;
  bool six_lowest = false;

  std::vector<double> rises_ms; ///< Each limit where a curve rises, ascending.
  bool heights_differ = false;  ///< By more than a hundredth.
  std::uint64_t early = 0;      ///< Early ends of six vehicles at 150 ms,
  std::uint64_t late = 0;       ///< of them those for a latency.

  /// @returns whether all early ends are for latencies, and all curves rise at
  /// one limit to heights that differ.
  bool late_results_only() const {
    return early > 0 && late == early && rises_ms.size() == 1 && heights_differ;
  }
};

/// @throws input_error when a run's files are broken.
curve_claims claims_of(const paper_runs& e);

/// @returns the milliseconds of a duration as sweeps have it, "80ms".
double ms_of(const std::string& duration_text);

/// The longest limit of the plot, where curves have their height.
inline constexpr auto longest_limit = "150ms";

} // namespace sofof::experiments::study
