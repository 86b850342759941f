// sofof sil: a scenario as processes of this host.
#include "experiments/sil/sil.hpp"

#include "apps/command.hpp"
#include "apps/program.hpp"
#include "apps/scenario_arguments.hpp"
#include "apps/signals.hpp"
#include "base/input_error.hpp"
#include "recording/results_folder.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::apps {

namespace {

struct sil_arguments {
  scenario_arguments what;
  std::string out;
  bool directly = false, force = false, quiet = false;
};

/// @returns the words that make other commands read the same scenario.
std::vector<std::string> words_of(const scenario_arguments& what) {
  std::vector<std::string> words;
  if (!what.seed.empty())
    words.insert(words.end(), {"--seed", what.seed});
  for (const auto& change : what.set)
    words.insert(words.end(), {"--set", change});
  return words;
}

int run(const sil_arguments& args) {
  const auto s = args.what.load();
  std::vector<std::string> providers;
  for (const auto& one : s.providers)
    if (!one.carrier) // one that rides is part of its vehicle's process
      providers.push_back(one.name);
  if (providers.empty())
    throw input_error("all providers of the scenario ride with vehicles, so "
                      "that none can be a process of its own; use sofof run");
  const auto given = args.out.empty()
                         ? std::nullopt
                         : std::optional<std::filesystem::path>{args.out};
  experiments::sil_options what{
      .program = std::filesystem::read_symlink(program_file),
      .scenario = find_scenario(args.what.file),
      .changes = words_of(args.what),
      .for_cars = {},
      .providers = std::move(providers),
      .directly = args.directly,
      .out = recording::make_results_folder(given, s.name + "-sil", s.seed,
                                            args.force, args.what.set)};
  if (!args.what.length.empty())
    what.for_cars = {"--duration", args.what.length};
  if (args.quiet)
    what.for_cars.emplace_back("--quiet");
  catch_signals();
  const auto code = run_sil(what, interrupted, std::cout);
  std::cout << what.out.string() << '\n';
  return code;
}

} // namespace

void add_sil(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "sil", "Drive a scenario as processes of this host, over a broker");
  auto args = std::make_shared<sil_arguments>();
  args->what.add_to(*command);
  command
      ->add_option("--out", args->out,
                   "Folder for the results of each process (default one of "
                   "its own in results/)")
      ->type_name("DIR");
  command->add_flag("--directly", args->directly,
                    "Cars connect to providers, without a broker");
  command->add_flag("--force", args->force,
                    "Write into a folder that is not empty");
  command->add_flag("--quiet", args->quiet, "No progress, no table");
  command->footer(
      "A broker, a process for each provider and one for all cars, which see "
      "each other only there. Runs on the wall clock.\nExample:\n  sofof sil "
      "config/ulm_lehr.toml --duration 60s");
  command->callback([args, &exit_code] { exit_code = run(*args); });
}

} // namespace sofof::apps
