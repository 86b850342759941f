// Reads a Lanelet2 map.
#pragma once

#include "maps/source_map.hpp"
#include "maps/xml_file.hpp"

namespace sofof::maps {

/// Reads lanelets of roads: their bounds, whichever way round they are drawn;
/// speeds of tags, or 50 and 100 km/h in and out of town; who yields, of
/// right-of-way elements. Lanelets of both directions become two lanes. One
/// follows another where their bounds share their ends. Nodes have `local_x`
/// and `local_y`, or are projected to UTM.
/// @param osm  Its root is <osm>.
/// @throws input_error with the place of what is wrong.
source_map read_lanelet2(const xml_file& osm);

} // namespace sofof::maps
