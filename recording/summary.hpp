// The figures of a run as one JSON object.
#pragma once

#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <string>

namespace sofof::recording {

/// @param m  Finished.
/// @returns the text of summary.json; absent figures are null. All but the
/// last two members, "timing" and "wall_s", depends on the records alone.
std::string summary_json(const metrics& m, const run_info& run,
                         const run_end& end);

} // namespace sofof::recording
