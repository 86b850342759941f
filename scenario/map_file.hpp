// Reads a map: lanes, houses and named routes.
#pragma once

#include "world/roads/streets.hpp"

#include <filesystem>
#include <string_view>

namespace sofof::scenario {

/// Reads a map file; docs/scenarios.md describes it.
/// @param file  What to call it in errors.
/// @throws input_error with file, line and column.
world::streets_ptr parse_map(std::string_view text,
                             const std::filesystem::path& file);

} // namespace sofof::scenario
