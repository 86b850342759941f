// What each split of a chain of services took at both ends, and saved.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>

namespace sofof::experiments::report {

/// @returns the section; without blocks where nothing was offloaded, and of
/// runs of older versions.
section energy_section(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
