// What vehicles learned of places, as a file.
#pragma once

#include "policies/algorithms/forecast/quality_map.hpp"
#include "scenario/scenario.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sofof::scenario {

/// @param s  Its providers and services are those that the file may name.
/// @throws input_error with file and line when it is not as it should be.
std::vector<known_place> read_quality(const std::filesystem::path& file,
                                      const scenario_definition& s);

/// @returns what a map has learned, as such a file.
std::string quality_csv(const policies::quality_map& learned,
                        const scenario_definition& s);

} // namespace sofof::scenario
