// The plan that a vehicle follows, whoever made it.
#pragma once

#include "messages/payload.hpp"
#include "messages/v2x/datum.hpp"
#include "world/ids.hpp"
#include "world/route.hpp"
#include "world/time.hpp"
#include "world/trajectory.hpp"

#include <memory>

namespace sofof {

/// @param result     Of trajectory planning: a trajectory from the vehicle's
///                   own planner, an MCM from a provider's; or nothing.
/// @param me         The vehicle; plans for others are none.
/// @param s_guess_m  About where the plan begins on the route, within 20 m.
/// @param before     The plan in use until now; null: none.
/// @returns the plan, sound; null for what is none.
std::shared_ptr<const trajectory>
plan_in_use(const payload& result, station_id me, const route& way,
            double s_guess_m, const datum& where, time_point now,
            const trajectory* before);

/// @returns whether a provider's result is a message that suggests a plan to
/// this vehicle, be it one that can be driven or not.
bool is_suggestion(const payload& result, station_id me);

/// Clocks of vehicles, sensors and providers agree within this.
inline constexpr duration clock_tolerance = std::chrono::milliseconds{200};

/// @returns whether something cannot have been seen yet. One such sighting
/// would make all true ones too old for an environment model.
constexpr bool is_of_future(time_point at, time_point now) {
  return at > now + clock_tolerance;
}

} // namespace sofof
