// What a planner keeps to of a drive that was agreed on.
#pragma once

#include "planners/crossing/crossing_member.hpp"
#include "planners/scene/driving_scene.hpp"

#include <optional>

namespace sofof::planners {

/// The vehicle for which something was agreed.
struct agreeing_car {
  double s_m = 0; ///< Rear axle on its route, laps included.
  double speed_mps = 0;
  double front_m = 0; ///< From there to its bumper.
};

/// @param now  Times are told from then on.
/// @returns the drive from the car on: up to where it waits, if it does before
/// it comes to the crossing; else when it is where, which binds from shortly
/// before the line on. Nothing if nothing was agreed.
std::optional<agreed_drive> agreed(const crossing_view& with, time_point now,
                                   const agreeing_car& car);

/// @returns where the front has to stop, as the drive does not bind and the car
/// cannot wait for that any longer; nullopt: nowhere so far.
std::optional<double> waiting_line_m(const crossing_view& with,
                                     const agreeing_car& car);

} // namespace sofof::planners
