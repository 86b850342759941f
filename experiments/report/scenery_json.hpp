// What stands still on the map of a drive.
#pragma once

#include "scenario/scenario.hpp"

#include <nlohmann/json_fwd.hpp>

namespace sofof::experiments::report {

/// @param what  Loaded.
/// @returns lanes, houses, obstacles, and providers with their areas and
/// sensors.
nlohmann::json scenery_json(const scenario::scenario_definition& what);

} // namespace sofof::experiments::report
