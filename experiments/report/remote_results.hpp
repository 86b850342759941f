// Latency and inter-arrival time of remote results, as figures.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

/// @param runs  Each is a curve; what it has not recorded is left out.
/// @returns latency and inter-arrival time by time and as cumulative
/// distributions with the limits of the service; a point for each result.
/// Nothing when there was no result.
std::vector<figure> remote_results(std::span<const recorded_run> runs,
                                   std::string_view service);

} // namespace sofof::experiments::report
