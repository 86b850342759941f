// Writes practice problems in the format that `sofof solve` reads.
#pragma once

#include <filesystem>
#include <string_view>

namespace sofof::experiments {

/// A drive down the slalom ("path"), or over the practice roads one after the
/// other ("velocity"): each instance starts where the plan of the one before
/// leads, plus noise.
/// @throws input_error for another kind, or when the file cannot be written.
void write_practice(const std::filesystem::path& file, std::string_view kind);

} // namespace sofof::experiments
