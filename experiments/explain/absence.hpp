// Why a run, a vehicle, a service or a moment has no episode.
#pragma once

#include "experiments/explain/episode.hpp"

#include <filesystem>
#include <string>

namespace sofof::experiments::explain {

/// @param folder    Of a run in which no vehicle has closed such an episode.
/// @param question  Whose episode was asked for.
/// @returns the run's headline, as far as it has one, and why there was none,
/// for a vehicle or a service apart.
/// @throws input_error when no vehicle ran there, the folder knows of no such
/// vehicle or service, or is broken.
std::string tell_absence(const std::filesystem::path& folder,
                         const question& question);

/// @param question  With a time at which no such episode ran.
/// @returns a sentence without its stop: that none ran then, and what became
/// of the request that was refused, or not made, within a second of it.
/// @throws input_error when the run was over then, had not begun, or its
/// folder is broken.
std::string tell_moment(const std::filesystem::path& folder,
                        const question& question);

} // namespace sofof::experiments::explain
