// Reads the lanes of a CommonRoad scenario.
#pragma once

#include "maps/source_map.hpp"
#include "maps/xml_file.hpp"

namespace sofof::maps {

/// Reads the lanelets of versions 2018b and 2020a with their successors,
/// speed limits of the lanelets or of traffic signs (without one, 50 km/h), and
/// who has to give way by a sign.
/// Obstacles, planning problems and traffic lights are counted and left out.
/// @param file  Its root is <commonRoad>.
/// @throws input_error with the place of what is wrong.
source_map read_commonroad(const xml_file& file);

} // namespace sofof::maps
