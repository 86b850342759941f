// Who claimed a crossing, and when.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>

namespace sofof::experiments::report {

/// @returns for each run figures of the windows that its vehicles claimed, by
/// the lanes on which they came, and how long claims took to bind; without
/// blocks where no vehicle claimed any.
/// @throws input_error when claims.csv is broken.
section crossing_section(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
