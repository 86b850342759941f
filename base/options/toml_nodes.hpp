// From text to TOML nodes, and back on one line.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace sofof {

/// @param file  What to call the text in errors.
/// @throws input_error with the place of what is no TOML.
toml::table parse_toml(std::string_view text, std::string_view file);

/// @returns a value as it could stand behind `key =`: tables in braces, as
/// `--set` takes them.
std::string value_text(const toml::node& value);

/// @returns a whole file that says what the table does.
std::string file_text(const toml::table& all);

} // namespace sofof
