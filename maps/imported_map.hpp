// A map as SOFOF drives it, made of one of another format.
#pragma once

#include "world/roads/lane.hpp"

#include "maps/source_map.hpp"
#include <optional>
#include <string>
#include <vector>

namespace sofof::maps {

/// A way over lanes, by their names.
struct lane_route {
  std::string name;
  std::vector<std::string> lanes;
  bool closed = false;
};

/// Lanes, smooth, with ways over them; and what its reader has to know.
struct imported_map {
  std::string name;
  std::optional<world::geo_origin> origin;
  std::vector<world::lane> lanes{};
  std::vector<lane_route> routes{};
  std::vector<departure> departures{};  ///< Of `routes`, in order of time.
  tally left_out{};                     ///< What of the source is not there.
  std::vector<std::string> warnings{};  ///< Sentences: lanes no car can follow.
  std::vector<std::string> too_sharp{}; ///< The names of these.
  point middle{}; ///< Of the map's frame, in the source's.
};

/// @returns a map file (docs/scenarios.md), of which `parse_map` makes the
/// same lanes, to the millimetre.
std::string to_toml(const imported_map& map);

/// @param file  Name of the map file, as the scenario names it.
/// @returns a scenario file with a fleet for each of the departures.
std::string to_scenario(const imported_map& map, const std::string& file);

} // namespace sofof::maps
