// What the channel holds in store, for a policy that is to know it.
#pragma once

#include "policies/api/context.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <memory>

namespace sofof::scenario {

/// Foresees the draws of vehicles' channels in virtual time: computing times,
/// delays, loss, stalls and outages of results with the phases that providers
/// draw, and when a provider fails and returns. Not foreseen: waits for workers
/// and for the radio cell, and phases that a CODM assigns.
/// @returns what makes the channel_oracle of each vehicle.
std::function<std::shared_ptr<const policies::channel_oracle>(station_id)>
foresee(const scenario_definition& s);

} // namespace sofof::scenario
