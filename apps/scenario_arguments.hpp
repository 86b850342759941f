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

  void add_to(CLI::App& command) {
    command
        .add_option("FILE", file,
                    "Scenario file (TOML), or its name in config/")
        ->required()
        ->type_name(" ");
    command.add_option("--seed", seed, "Seed of all randomness")
        ->type_name("N");
    command.add_option("--duration", length, "Length of the run, with a unit")
        ->type_name("600s");
    command
        .add_option("--set", set,
                    "Change an option of the file, e.g. network.profile=ideal")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
  }

  scenario::scenario_definition load() const {
    auto overrides = set;
    if (!seed.empty())
      overrides.push_back("--seed=" + seed);
    if (!length.empty())
      overrides.push_back("--duration=" + length);
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
