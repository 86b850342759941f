// Reads a network of SUMO.
#pragma once

#include "maps/source_map.hpp"
#include "maps/xml_file.hpp"

namespace sofof::maps {

/// Reads a `.net.xml`: normal and internal lanes that passenger cars may
/// drive, the connections between them, and who yields to whom. The frame's
/// origin is the middle of the network.
/// U-turns are left out: no car of ours turns in 3 m.
/// @param net  Its root is <net>.
/// @throws input_error with the place of what is wrong.
source_map read_sumo_net(const xml_file& net);

/// Adds the routes and departures of a `.rou.xml`. Trips and flows are
/// counted and left out: duarouter makes routes of them.
/// @throws input_error with the place of what is wrong.
void read_sumo_routes(const xml_file& routes, source_map& to);

} // namespace sofof::maps
