// How single values look in a TOML file.
#pragma once

#include <string>
#include <string_view>

namespace sofof {

/// @param text  UTF-8.
/// @returns a basic string: in quotes, with escapes where they are needed.
std::string quoted_toml(std::string_view text);

/// @returns the shortest number that reads back as exactly `value`, with a
/// point or exponent so that it stays a float.
std::string number_text(double value);

} // namespace sofof
