// Why a run, a vehicle or a service has no episode.
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

} // namespace sofof::experiments::explain
