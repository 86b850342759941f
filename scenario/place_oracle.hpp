// A forecast of quality by place that knows the channel's areas.
#pragma once

#include "policies/api/quality_forecast.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <memory>

namespace sofof::scenario {

/// Knows the law of each channel at each place, not its draws: how likely a
/// result is late or lost by computing, network delay, drift's mean and loss.
/// Not foreseen: stalls, bursts, outages, and waits for workers and the cell.
/// @param s  Loaded.
/// @returns what makes the forecast of each vehicle.
std::function<std::shared_ptr<policies::quality_forecast>()>
foresee_places(const scenario_definition& s);

} // namespace sofof::scenario
