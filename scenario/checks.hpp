// Checks what no single option of a scenario can tell.
#pragma once

#include "base/options/toml_file.hpp"
#include "scenario/scenario.hpp"

namespace sofof::scenario {

/// Refuses a scenario whose parts do not fit together: names that are doubled
/// or that nothing bears, station ids used twice, vehicles without room, or, if
/// they are to, that cannot take their functions back.
/// @param all     With its world.
/// @param source  Knows the places.
/// @throws input_error.
void check_whole(const scenario_definition& all, const toml_file& source);

} // namespace sofof::scenario
