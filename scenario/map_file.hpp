// Reads a map: lanes, houses and named routes.
#pragma once

#include "base/options/option_visitor.hpp"
#include "world/roads/streets.hpp"

#include <filesystem>
#include <string_view>

namespace sofof::scenario {

/// Reads a map file; docs/scenarios.md describes it.
/// @param file  What to call it in errors.
/// @throws input_error with file, line and column.
world::streets_ptr parse_map(std::string_view text,
                             const std::filesystem::path& file);

/// Lists the options of a map's file, those of an empty one.
void list_map_options(option_visitor& s);

} // namespace sofof::scenario
