// Latency, age of the input and inter-arrival time of remote results, as
// figures.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

/// @param runs  What they have not recorded is left out.
/// @returns each quantity by time and as a distribution, with the limits of the
/// service and a point for each result; a curve for each provider of a run by
/// itself, for each run of several. Nothing when there was no result.
std::vector<figure> remote_results(std::span<const recorded_run> runs,
                                   std::string_view service);

} // namespace sofof::experiments::report
