// What a log of seeds says, for people.
#pragma once

#include "experiments/torture/seed_log.hpp"

#include <filesystem>
#include <string>

namespace sofof::experiments::torture {

/// @param findings  Where the scenarios of findings are.
/// @returns hours, episodes, each class of faults, and the findings.
std::string table_of(const seed_log& log,
                     const std::filesystem::path& findings);

} // namespace sofof::experiments::torture
