// Who ran the services of a chain, and how late vehicles responded.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

#include <span>

namespace sofof::experiments::report {

/// @returns a figure of each run that has a chain of services. It has a strip
/// for each service; below, by time, each measured response, from a look of a
/// vehicle's sensors to the first control value by it; how long the scene
/// allows that to take, if a policy has asked for it; and what the limits of
/// the split admit.
section chain_section(std::span<const recorded_run> runs);

} // namespace sofof::experiments::report
