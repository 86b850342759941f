// What a report says of results folders.
#pragma once

#include "experiments/report/document.hpp"

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

/// A run by itself: its drive, key figures, the remote results of each
/// service, episodes, vehicles, configuration.
/// @throws input_error when it is no results folder, or broken.
std::vector<section> describe_run(const std::filesystem::path& folder);

/// The same of two runs: first what differs, then drives side by side under one
/// clock, key figures with their difference, both curves in each figure.
/// @throws input_error as above.
std::vector<section> compare_runs(const std::filesystem::path& first,
                                  const std::filesystem::path& second);

/// A report on one folder, on two side by side, or on more, one after the
/// other, behind what differs, a table of their key figures and common figures.
/// @param folders  At least one.
/// @param version  Of this program.
/// @throws input_error as above.
document describe(std::span<const std::filesystem::path> folders,
                  std::string_view version);

} // namespace sofof::experiments::report
