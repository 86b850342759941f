// Drives a scenario of one car, and keeps where that was.
#pragma once

#include "experiments/judge/ks_model.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <span>
#include <vector>

namespace sofof::experiments::judge {

/// Runs the scenario in virtual time, up to its end or for as long as somebody
/// wants.
/// @param s        With one vehicle, whose tracks are recorded every 10 ms.
/// @param start    Of this.
/// @param is_over  Asked once a second.
/// @returns where the car was, every 10 ms from the start on.
/// @throws std::runtime_error when something of it dies.
std::vector<driven_moment>
drive(const scenario::scenario_definition& s, const world::vehicle_state& start,
      const std::function<bool(std::span<const driven_moment>)>& is_over);

} // namespace sofof::experiments::judge
