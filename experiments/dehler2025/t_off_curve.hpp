// Offloading time against the longest gap that is allowed, as a curve.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"
#include "experiments/report/document.hpp"

#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::study {

/// @returns "1 vehicle", "6 vehicles".
std::string count_of_vehicles(const std::string& vehicles);

/// @param runs      Axes: vehicles, max_interarrival.
/// @param vehicles  A value of the first one.
/// @returns the mean t_off at each limit of the second, with its interval; the
/// points without an offloading are gaps.
report::curve t_off_curve(std::span<const measured_run> runs,
                          const std::string& vehicles, const std::string& name);

/// @returns a figure for such curves, yet without them.
report::figure t_off_figure(std::string title);

} // namespace sofof::experiments::study
