// Tables of what a run comes down to, one run beside the other.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>
#include <vector>

namespace sofof::experiments::report {

/// @param runs  Columns; of two the difference follows, as `comparison` has it.
/// Where a run has no
///              figure there is a dash; figures that no run has are left out.
/// @returns a table for the run, one for each service, one for safety and
/// comfort, one for what was on the air; none of no rows.
std::vector<table> key_figures(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
