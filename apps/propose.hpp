// A first scenario for a map.
#pragma once

#include <string>

namespace sofof::apps {

/// @param map   A map file.
/// @param name  What to call the scenario.
/// @param out   Where it will be written: it names the map from its folder on.
/// @returns a scenario with cars on the map's routes and providers at its
/// busiest junctions.
/// @throws input_error for a map that cannot be read or has no routes.
std::string proposed_text(const std::string& map, const std::string& name,
                          const std::string& out);

} // namespace sofof::apps
