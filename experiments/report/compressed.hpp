// Text that a page carries compressed.
#pragma once

#include <string>
#include <string_view>

namespace sofof::experiments::report {

/// @returns the text in zlib's format, in Base64: a browser inflates it by
/// `DecompressionStream("deflate")`.
std::string compressed(std::string_view text);

} // namespace sofof::experiments::report
