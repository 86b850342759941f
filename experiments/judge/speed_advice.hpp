// How fast to drive, so that one is in a goal's place when one should be.
#pragma once

#include "world/roads/route.hpp"

#include "maps/commonroad_scene.hpp"
#include "maps/imported_map.hpp"

namespace sofof::experiments::judge {

/// Lowers speed limits along the way, as a navigation would ask for: a car that
/// would be through the goal's place before its time drives slower up to there,
/// and in the place nobody is faster than the goal allows. It does not know of
/// anybody else on the road. Of several goals the first one that lies on the
/// way counts.
/// @param problem  In the map's frame.
/// @param step_s   Of its times.
/// @param way      Of the map; its only route.
/// @param start_m  Of the vehicle's middle, arc length on the way.
void advise_speeds(maps::imported_map& map,
                   const maps::planning_problem& problem, double step_s,
                   const world::route& way, double start_m);

} // namespace sofof::experiments::judge
