// The command-line arguments that name a scenario and change it.
#pragma once

#include "apps/find_scenario.hpp"
#include "base/input_error.hpp"
#include "scenario/load.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace sofof::apps {

struct scenario_arguments {
  std::string file;
  std::vector<std::string> set; ///< KEY=VALUE, in the order given.
  std::string seed;
  std::string length;

  /// @param with_length  Whether the length of a run is for the user to say.
  void add_to(CLI::App& command, bool with_length = true) {
    command
        .add_option("FILE", file,
                    "Scenario file (TOML), or its name in config/")
        ->required()
        ->type_name(" ");
    command.add_option("--seed", seed, "Seed of all randomness")
        ->type_name("N");
    if (with_length)
      command
          .add_option("--duration", length, "Length of the run, with a unit")
          ->type_name("600s");
    command
        .add_option("--set", set,
                    "Change an option of the file, e.g. network.profile=ideal")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
  }

  /// @returns what changes the file, as `load_scenario` takes it.
  std::vector<std::string> changes() const {
    auto all = set;
    if (!seed.empty())
      all.push_back("--seed=" + seed);
    if (!length.empty())
      all.push_back("--duration=" + length);
    return all;
  }

  scenario::scenario_definition load() const {
    const auto overrides = changes();
    const auto found = find_scenario(file);
    try {
      return scenario::load_scenario(found, overrides);
    } catch (const input_error&) {
      refuse_map(found);
      throw;
    }
  }
};

} // namespace sofof::apps
