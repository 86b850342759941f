// What a report says of a folder of sweeps.
#pragma once

#include "experiments/report/document.hpp"

#include <filesystem>
#include <string_view>

namespace sofof::experiments::study {

/// @returns whether `sofof sweep` or `sofof reproduce` has written a folder.
bool is_sweep_folder(const std::filesystem::path& folder);

/// A section for each sweep in it: figures over the axis that has most numbers,
/// a curve for each combination of the others, and a table of all points.
/// @param version  Of this program.
/// @throws input_error when a table or a run is missing or broken.
report::document describe_sweeps(const std::filesystem::path& folder,
                                 std::string_view version);

} // namespace sofof::experiments::study
