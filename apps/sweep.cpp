// sofof sweep: many runs of one scenario.
#include "apps/command.hpp"
#include "apps/signals.hpp"
#include "apps/sweep_arguments.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace sofof::apps {

namespace {

struct sweep_command {
  std::string file;
  std::vector<std::string> set; ///< KEY=VALUE, in the order given.
  sweep_arguments runs;
};

int tell_outcome(const experiments::sweep_outcome& outcome) {
  if (outcome.interrupted) {
    std::cout << "interrupted; the same command goes on from here\n";
    return static_cast<int>(scenario::run_outcome::interrupted);
  }
  std::cout << fmt::format("{} good, {} unsafe, {} failed; results in {}\n",
                           outcome.good, outcome.unsafe, outcome.failed,
                           outcome.table.string());
  return static_cast<int>(outcome.all_good() ? scenario::run_outcome::good
                                             : scenario::run_outcome::failed);
}

int obey(const sweep_command& args) {
  const auto plan = experiments::load_sweep(args.file, args.set);
  const auto part = args.runs.part();
  const auto how = args.runs.given(plan.name);
  if (args.runs.count) {
    std::cout << experiments::count_runs({&plan, 1}, how.program, interrupted)
              << '\n';
    return static_cast<int>(scenario::run_outcome::good);
  }
  if (!part)
    return tell_outcome(experiments::sweep(plan, how, interrupted, std::cout));
  return tell_shard(
      experiments::make_shard({&plan, 1}, how, *part, interrupted, std::cout),
      *part, (how.out / (plan.name + ".csv")).string());
}

} // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("sweep", "Run a scenario many times, varied");
  auto args = std::make_shared<sweep_command>();
  command->add_option("FILE", args->file, "Sweep file (TOML)")
      ->required()
      ->type_name(" ");
  args->runs.add_to(*command);
  command
      ->add_option("--set", args->set,
                   "Change an option of the scenario in all runs")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command->footer("Example:\n  sofof sweep config/paper/latency_plot.toml -j 2 "
                  "--out results/paper");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = obey(*args);
  });
}

} // namespace sofof::apps
