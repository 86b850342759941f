// From a scenario file to a scenario that is ready to run.
#pragma once

#include "scenario/scenario.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sofof::scenario {

/// Reads a scenario, its map and its trace; checks everything that can be
/// known before the run.
/// @param file       TOML; docs/scenarios.md describes it. Files named in it
///                   are sought from its folder on.
/// @param overrides  "KEY=VALUE" as given to `--set`, applied in this order
///                   before anything is checked.
/// Options at former places are told once on stderr.
/// @throws input_error with the place of the first mistake.
scenario_definition load_scenario(const std::filesystem::path& file,
                                  std::span<const std::string> overrides = {});

/// The same for text in memory, which need not be run: of notes nothing is
/// told, and programs that decide need not be there.
/// @param file  Where it could stand.
scenario_definition parse_scenario(std::string_view text,
                                   const std::filesystem::path& file,
                                   std::span<const std::string> overrides = {});

/// The same for a map that is in memory, too.
/// @param map_text  What the file of the map would say.
scenario_definition load_with_map(std::string_view text, std::string map_text,
                                  const std::filesystem::path& file,
                                  std::span<const std::string> overrides = {});

} // namespace sofof::scenario
