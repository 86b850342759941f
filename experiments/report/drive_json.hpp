// A drive as apps/report shows it: streets, areas, tracks, offloadings, events.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace sofof::experiments::report {

/// Reads a results folder. Without tracks there are no vehicles in it; where
/// no vehicle ran, offloadings are those that the provider served.
/// @throws input_error when it is no results folder, or broken.
nlohmann::json drive_json(const std::filesystem::path& folder);

} // namespace sofof::experiments::report
