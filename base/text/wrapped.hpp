// Text in lines that end between words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sofof {

/// @param text    One or several lines.
/// @param width   Columns (characters of UTF-8) of a line; a longer word stands
///                alone on a line of its own.
/// @param indent  Columns before each line that this begins.
std::string wrapped(std::string_view text, std::size_t width,
                    std::size_t indent = 0);

} // namespace sofof
