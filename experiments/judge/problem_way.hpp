// Over which lanes a planning problem is driven.
#pragma once

#include "maps/commonroad_scene.hpp"
#include "maps/imported_map.hpp"
#include <string>
#include <variant>

namespace sofof::experiments::judge {

/// The route of that name is the way.
inline constexpr auto way_name = "ego";

/// What no way is, in a sentence.
struct no_way {
  std::string why;
};

/// Finds the shortest way, without lane changes, from the lane on which the
/// vehicle is to one that leads through a goal's place; without a place,
/// straight on.
/// @param map      In its own frame.
/// @param problem  In the map's frame.
/// @returns the map with this way as its only route. It begins behind the
/// vehicle and goes on behind the goal, off the map if need be: nobody stops
/// where the file ends.
std::variant<maps::imported_map, no_way>
choose_way(maps::imported_map map, const maps::planning_problem& problem);

} // namespace sofof::experiments::judge
