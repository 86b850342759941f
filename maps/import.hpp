// Makes a map of SOFOF of one of another format.
#pragma once

#include "maps/imported_map.hpp"
#include <string>
#include <string_view>

namespace sofof::maps {

/// A file in memory.
struct named_text {
  std::string_view text;
  std::string file; ///< What to call it in errors.
};

/// Reads a network of SUMO (`.net.xml`), a Lanelet2 map (`.osm`) or a
/// CommonRoad scenario (`.xml`): its first element says which.
/// @param map     The file.
/// @param name    What to call the map.
/// @param routes  Routes of SUMO (`.rou.xml`); without text, ways are proposed.
/// @throws input_error with the place of what is wrong; for OpenDRIVE and
///         plain OpenStreetMap with the command that makes a network of it.
imported_map import(const named_text& map, const std::string& name,
                    const named_text& routes = {});

} // namespace sofof::maps
