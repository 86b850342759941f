// How fast vehicles drove, how many were offloaded, and for how long, by time.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>

namespace sofof::experiments::report {

/// @returns figures of mean speed and of the share of vehicles that are
/// offloaded, each second, and of t_off of each episode by its end, for each
/// service; without blocks where nothing of it was recorded. Of several runs
/// each is a curve.
/// @throws input_error when tracks.csv is broken.
section over_time(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
