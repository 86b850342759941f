// A run in the formats of other tools.
#pragma once

#include <filesystem>

namespace sofof::experiments::convert {

/// Writes what a results folder holds as the ending of the file says:
///   .mcap      for Foxglove and Lichtblick
///   .fcd.xml   floating car data, as SUMO writes and reads them
///   .geojson   lanes, areas and ways on Earth (RFC 7946)
///   .latencies.csv  a trace of its latencies, for other runs to replay
/// Reads and writes row by row. The file is there once it is complete.
/// @throws input_error when the ending is another one, the folder broken, or
/// the file cannot be written.
void convert(const std::filesystem::path& folder,
             const std::filesystem::path& file);

} // namespace sofof::experiments::convert
