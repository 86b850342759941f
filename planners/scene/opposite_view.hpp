// What a car sees of the lane opposite its own.
#pragma once

#include "planners/scene/driving_scene.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/overtaking.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// Adds a body if it is on the opposite lane, from an arc length on up to
/// another one: as it comes, or as what stands there, whatever it does else.
void add_if_opposite(const world::route& way, double from_m, double to_m,
                     const track& x, std::vector<oncoming_body>& out);

/// @param eye      Of the car.
/// @param from_m   Arc length on its route: nearer places are in sight.
/// @param range_m  Of its sensor, to the middle of a body.
/// @param houses   Hide what is behind them; null: there are none.
/// @param hides    A body that does so, too.
/// @returns up to where the middle of the opposite lane is in sight, arc
/// length.
double opposite_in_sight_m(const world::route& way, point eye, double from_m,
                           double range_m, const line_of_sight* houses,
                           const oriented_box& hides);

/// Where a car waits behind a body, it stands so far left that it sees past it,
/// as far as who comes has room.
/// @param body_left_m  How far left the body reaches; left positive.
/// @param rests_m      The car's front comes no farther, arc length.
/// @returns what keeps it there, as a body that is passed on the left; nullopt:
/// it sees past it as it is.
std::optional<lane_obstacle> look_past(double body_left_m, double rests_m,
                                       double half_lane_m,
                                       const world::vehicle_params& car);

} // namespace sofof::planners
