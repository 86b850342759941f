// What energy is reckoned from in a scenario.
#pragma once

#include "recording/run_info.hpp"
#include "scenario/build.hpp"
#include "scenario/scenario.hpp"

namespace sofof::scenario {

/// @returns what the services of the vehicles that are driven here take, what
/// providers take, and which services are a chain.
recording::energy_terms energy_terms_of(const scenario_definition& s,
                                        const process_share& here);

} // namespace sofof::scenario
