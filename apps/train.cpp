// sofof train: a policy learns by driving.
#include "apps/command.hpp"
#include "apps/find_scenario.hpp"
#include "apps/signals.hpp"
#include "experiments/benchmark/training.hpp"
#include "scenario/run.hpp"

#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace sofof::apps {

namespace {

struct train_arguments {
  std::vector<std::string> files;
  std::string out;
  bool quiet = false;
  experiments::bench::training_options options;

  int obey() {
    for (const auto& file : files)
      options.scenarios.emplace_back(find_scenario(file));
    options.version = SOFOF_VERSION;
    options.out = out.empty() ? options.policy + ".txt" : out;
    if (!quiet)
      options.show = isatty(STDOUT_FILENO) != 0
                         ? recording::progress::output::terminal
                         : recording::progress::output::plain;
    if (!experiments::bench::train(options, interrupted, std::cout)) {
      std::cout << "interrupted; nothing was written\n";
      return static_cast<int>(scenario::run_outcome::interrupted);
    }
    std::cout << "snapshot in " << options.out.string() << '\n';
    return static_cast<int>(scenario::run_outcome::good);
  }
};

} // namespace

void add_train(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("train", "Let a policy learn by driving scenarios");
  auto args = std::make_shared<train_arguments>();
  command->add_option("FILES", args->files, "Scenario files (TOML)")
      ->required()
      ->type_name(" ");
  command
      ->add_option("--policy", args->options.policy,
                   "q_learning, dqn, ucb1 or alto")
      ->required()
      ->type_name("NAME");
  args->options.seeds = 20;
  command
      ->add_option("--seeds", args->options.seeds,
                   "How often it drives each, with seeds from 1000 on "
                   "(default 20)")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000));
  command
      ->add_option("--set", args->options.set,
                   "Change an option of the scenarios or of the policy, e.g. "
                   "policies.lodm.discount=0.9")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command
      ->add_option("--out", args->out,
                   "File that gets what it has learned (default NAME.txt)")
      ->type_name("FILE");
  command->add_flag("--quiet", args->quiet, "No progress");
  command->footer(
      "Example:\n  sofof train config/bench/*.toml --policy dqn\n\n"
      "and then, in a scenario:\n  lodm = { name = \"dqn\", snapshot = "
      "\"dqn.txt\" }\n\n"
      "The snapshots in policies/algorithms/learning/snapshots are built into "
      "the program.");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = args->obey();
  });
}

} // namespace sofof::apps
