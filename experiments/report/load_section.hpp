// How busy workers and radio cells were: a table, curves over time, and what
// was sent for what.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>

namespace sofof::experiments::report {

/// @returns the section; without blocks where no run has measured any load, as
/// those of older versions.
/// @throws input_error when load.csv or octets.csv is broken.
section load_section(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
