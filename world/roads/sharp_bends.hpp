// Bends that no car can follow: a map is drawn by people.
#pragma once

#include "world/roads/road_map.hpp"

#include <span>
#include <string>
#include <vector>

namespace sofof::world {

/// A part of a route that bends more than a car can steer.
struct sharp_bend {
  std::string lane;    ///< Where it is sharpest.
  point at;            ///< The same place, m.
  double turn_rad = 0; ///< How far it turns, without a sign.
  double radius_m = 0; ///< Where it is sharpest.
};

/// @param map       Whose lanes the routes go along.
/// @param routes    What cars drive on.
/// @param least_radius_m  That a car can drive, > 0.
/// @returns each such bend once, however many routes go through it, in the
/// order of the routes.
std::vector<sharp_bend> sharp_bends(const road_map& map,
                                    std::span<const route_ptr> routes,
                                    double least_radius_m);

} // namespace sofof::world
