// The figures of a run for the eye: what a console shows in the end.
#pragma once

#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <filesystem>
#include <string>

namespace sofof::recording {

/// @param m       Finished.
/// @param folder  Where the files are; empty: they could not be written.
/// @param colour  The reader is a terminal.
/// @returns lines of at most 80 columns (names and paths may be longer),
/// with figures in columns, one per kind of service.
std::string table(const metrics& m, const run_info& run, const run_end& end,
                  const std::filesystem::path& folder, bool colour);

} // namespace sofof::recording
