// The vehicles of a run, one a row.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

namespace sofof::experiments::report {

/// @returns how each vehicle drove; nothing for a run that was killed before
/// it told. No title.
/// @throws input_error with the place of what is wrong in vehicles.csv.
table vehicle_table(const recorded_run& run);

} // namespace sofof::experiments::report
