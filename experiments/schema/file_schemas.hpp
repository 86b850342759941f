// The kinds of files that people write for SOFOF, and their schemas.
#pragma once

#include "base/options/option_tree.hpp"

#include <array>
#include <string>
#include <string_view>

namespace sofof::experiments::schema {

/// What there are schemas of.
inline constexpr std::array<std::string_view, 4> file_kinds{
    "scenario", "map", "sweep", "entrants"};

/// @returns all options of a scenario; walks them once in a process.
const option_table& scenario_options();

/// @returns all options of a map.
const option_table& map_options();

/// @param kind  One of `file_kinds`.
/// @returns the JSON schema of such files, draft 7, as text.
/// @throws input_error for another kind.
std::string schema_of(std::string_view kind);

} // namespace sofof::experiments::schema
