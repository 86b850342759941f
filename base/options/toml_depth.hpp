// How deep a TOML text nests.
#pragma once

#include <cstddef>
#include <string_view>

namespace sofof {

/// Tables and lists around a value, those that dots in keys and headers make
/// among them. Parsers of TOML call themselves for each.
inline constexpr std::size_t most_toml_depth = 64;

/// Refuses a text that nests deeper than `most_toml_depth`. Whether it is TOML
/// otherwise is for the parser to say.
/// @param file  What to call it.
/// @throws input_error, with file, line and column.
void check_toml_depth(std::string_view text, std::string_view file);

} // namespace sofof
