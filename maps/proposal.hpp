// A first scenario on a map.
#pragma once

#include "world/roads/streets.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::maps {

/// A place where lanes cross, and how many ways lead through it.
struct junction {
  point at;
  double ways = 0;  ///< Pairs of a way and a crossing of lanes on it.
  std::string name; ///< Of a lane there.
};

/// @returns junctions, the busiest first, no two of them nearer to each other
/// than `apart_m`.
std::vector<junction> busiest_junctions(const world::streets& world,
                                        std::size_t most, double apart_m);

/// @param name  Of the scenario.
/// @param map   File of the map, as the scenario names it.
/// @returns a scenario file: 20 cars on the map's routes and providers at its
/// busiest junctions, three at most.
/// @throws std::invalid_argument for a map without routes.
std::string propose_scenario(const world::streets& world, std::string_view name,
                             std::string_view map);

} // namespace sofof::maps
