// What a planner keeps to of a drive that was agreed on.
#pragma once

#include "planners/crossing/crossing_member.hpp"
#include "planners/scene/driving_scene.hpp"

namespace sofof::planners {

/// @param s_m  Rear axle of the car on its route, laps included.
/// @returns the drive from there on: up to where it waits, if it does before it
/// comes to the crossing; else when it is where from shortly before the line on.
std::optional<agreed_drive> agreed(const crossing_view& with, time_point now,
                                   double s_m, double speed_mps,
                                   double front_m);

} // namespace sofof::planners
