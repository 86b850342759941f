// sofof bench: every policy in every scenario, ranked.
#include "experiments/benchmark/bench.hpp"

#include "apps/command.hpp"
#include "apps/find_scenario.hpp"
#include "apps/signals.hpp"
#include "apps/sweep_arguments.hpp"

#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace sofof::apps {

namespace {

constexpr auto usual_entrants = "config/policies.toml";

struct bench_arguments {
  std::vector<std::string> files;
  std::string policies = "all";
  std::string entrants;
  std::vector<std::string> set; ///< KEY=VALUE, in the order given.
  std::size_t seeds = 3;
  sweep_arguments runs;

  /// @returns the plain ones, those of the file, and scenarios' own.
  std::vector<experiments::bench::entrant> known() const {
    auto all = experiments::bench::plain_entrants();
    const std::filesystem::path file =
        entrants.empty() ? usual_entrants : entrants;
    if (!entrants.empty() || std::filesystem::exists(file))
      std::ranges::move(experiments::bench::load_entrants(file),
                        std::back_inserter(all));
    else if (policies == "all")
      std::cerr << "sofof: there is no " << usual_entrants
                << " here, so nobody takes part but the policies themselves "
                   "(--entrants FILE)\n";
    experiments::bench::add_own_entrants(all, files);
    return all;
  }

  /// Decisions are timed by one shard: times of several machines say nothing.
  static int make_part(experiments::bench::bench_options what,
                       const experiments::shard& which) {
    const auto measures = which.number == experiments::measuring_shard;
    what.runs.make = experiments::virtual_runs(SOFOF_VERSION, measures);
    return tell_shard(
        experiments::bench::bench_shard(what, which, interrupted, std::cout),
        which, (what.runs.out / "report.html").string());
  }

  int obey() const {
    experiments::bench::bench_options what;
    for (const auto& file : files)
      what.scenarios.emplace_back(find_scenario(file));
    what.entrants = experiments::bench::chosen_from(known(), policies);
    what.set = set;
    what.seeds = seeds;
    what.runs = runs.given("bench");
    what.colour = isatty(STDOUT_FILENO) != 0;
    const auto part = runs.part();
    if (runs.count) {
      std::cout << experiments::count_runs(plans_of(what), what.runs.program,
                                           interrupted)
                << '\n';
      return static_cast<int>(scenario::run_outcome::good);
    }
    if (part)
      return make_part(what, *part);
    const auto outcome =
        experiments::bench::bench(what, interrupted, std::cout);
    if (outcome.interrupted) {
      std::cout << "interrupted; the same command goes on from here\n";
      return static_cast<int>(scenario::run_outcome::interrupted);
    }
    std::cout << "report in " << (what.runs.out / "report.html").string()
              << '\n';
    return static_cast<int>(outcome.all_good ? scenario::run_outcome::good
                                             : scenario::run_outcome::failed);
  }
};

} // namespace

void add_bench(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "bench", "Rank policies: every one in every scenario, the same noise");
  auto args = std::make_shared<bench_arguments>();
  command->add_option("FILES", args->files, "Scenario files (TOML)")
      ->required()
      ->type_name(" ");
  command
      ->add_option("--policies", args->policies,
                   "Who takes part, see docs/bench.md (default all)")
      ->type_name("NAME,...");
  command
      ->add_option("--entrants", args->entrants,
                   "File with entrants beside the plain policies (default "
                   "config/policies.toml, if it is there)")
      ->type_name("FILE");
  command
      ->add_option("--seeds", args->seeds,
                   "How many runs of each, with seeds from 1 on (default 3)")
      ->type_name("N")
      ->check(CLI::Range(1, 999)); // from 1000 on for training
  args->runs.add_to(*command);
  command
      ->add_option(
          "--set", args->set,
          "Change an option of the scenarios, no policy's, in all runs")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command->footer("Example:\n  sofof bench config/bench/*.toml --policies "
                  "location,nearest --seeds 5");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = args->obey();
  });
}

} // namespace sofof::apps
