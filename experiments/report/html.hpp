// A report as one HTML file that needs nothing else.
#pragma once

#include "experiments/report/document.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace sofof::experiments::report {

/// @returns the page: what apps/report/dist holds, with the document in it as
/// JSON. A drive's folder is read.
/// @throws input_error when a drive's folder is broken.
std::string html(const document& what);

/// Writes the page; whoever sees the file sees all of it.
/// @param choose  What the user can do about a file that cannot be written:
///                choose ...
/// @throws input_error as `html` does, or when it cannot be written.
void write_html(const document& what, const std::filesystem::path& file,
                std::string_view choose = "another file with -o");

} // namespace sofof::experiments::report
