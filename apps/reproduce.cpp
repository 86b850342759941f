// sofof reproduce: the paper's evaluation with one command.
#include "experiments/dehler2025/reproduce.hpp"

#include "apps/command.hpp"
#include "apps/signals.hpp"
#include "apps/sweep_arguments.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

namespace {

struct reproduce_arguments {
  std::string folder = "config/paper";
  bool full = false;
  std::string trace;
  sweep_arguments runs;

  int obey() const {
    const experiments::study::reproduction_options all{
        folder, SOFOF_VERSION, runs.given("paper"), full, trace};
    const auto page = (all.runs.out / "report.html").string();
    const auto part = runs.part();
    if (runs.count) {
      std::cout << experiments::count_runs(
          experiments::study::next_plans(all, interrupted), all.runs.program,
          interrupted)
                << '\n';
      return static_cast<int>(scenario::run_outcome::good);
    }
    if (part)
      return tell_shard(experiments::study::reproduce_shard(
                            all, *part, interrupted, std::cout),
                        *part, page);
    if (!experiments::study::reproduce(all, interrupted, std::cout)) {
      std::cout << "interrupted; the same command goes on from here\n";
      return static_cast<int>(scenario::run_outcome::interrupted);
    }
    std::cout << "report in " << page << '\n';
    return static_cast<int>(scenario::run_outcome::good);
  }
};

} // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "reproduce", "Run the paper's evaluation and report on it");
  auto args = std::make_shared<reproduce_arguments>();
  command
      ->add_option("FOLDER", args->folder,
                   "Of the sweep files (default config/paper)")
      ->type_name(" ");
  command->add_flag("--full", args->full,
                    "Narrow intervals: up to ten times as many runs; says "
                    "first how many hours that are");
  command
      ->add_option("--trace", args->trace,
                   "Your own latencies in place of the channel models "
                   "(docs/channels.md#trace)")
      ->type_name("FILE");
  args->runs.add_to(*command);
  command->footer("Takes up to 20 minutes on two cores; what is finished is "
                  "kept.\n"
                  "Example:\n  sofof reproduce --out results/paper");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = args->obey();
  });
}

} // namespace sofof::apps
