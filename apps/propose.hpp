// Writes a first scenario for a map.
#pragma once

#include <string>

namespace sofof::apps {

/// @param map   A map file.
/// @param name  What to call the scenario.
/// @param out   Where it is written; it names the map from its folder on.
/// @throws input_error for a map that cannot be read or has no routes.
void propose(const std::string& map, const std::string& name,
             const std::string& out);

} // namespace sofof::apps
