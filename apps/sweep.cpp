// sofof sweep: many runs of one scenario.
#include "apps/address_argument.hpp"
#include "apps/command.hpp"
#include "apps/signals.hpp"
#include "apps/sweep_arguments.hpp"
#include "network/http/server.hpp"
#include "recording/exposition.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sofof::apps {

namespace {

struct sweep_command {
  std::string file;
  std::vector<std::string> set; ///< KEY=VALUE, in the order given.
  std::string metrics;
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

/// How far a sweep is, for Prometheus.
std::string figures_of(const experiments::making_progress& all,
                       recording::exposition_format format) {
  using kind = recording::exposition::kind;
  recording::exposition to{format};
  to.family("sofof_build_info", kind::gauge, "What runs here.");
  to.sample({{"version", SOFOF_VERSION}, {"role", "sweep"}}, std::uint64_t{1});
  to.family("sofof_sweep_points", kind::gauge, "Runs that are wanted.");
  to.sample({}, std::uint64_t{all.runs});
  to.family("sofof_sweep_points_found", kind::gauge,
            "Runs of them that were there before.");
  to.sample({}, std::uint64_t{all.found});
  to.family("sofof_sweep_points_done", kind::counter,
            "Runs that were made, by how they ended.");
  to.sample({{"status", "ok"}}, std::uint64_t{all.good});
  to.sample({{"status", "unsafe"}}, std::uint64_t{all.unsafe});
  to.sample({{"status", "failed"}}, std::uint64_t{all.failed});
  return to.finish();
}

network::http::response page_of(const experiments::making_progress& all,
                                const network::http::request& asked) {
  if (asked.path == "/healthz")
    return {.body = "ready\n"};
  const auto format = recording::format_for(asked.accept);
  if (asked.path == "/metrics")
    return {200, std::string{recording::type_of(format)},
            figures_of(all, format)};
  constexpr unsigned not_found = 404;
  return {.status = asked.path == "/" ? 200 : not_found,
          .body = "sofof sweep\n/metrics\n/healthz\n"};
}

int obey(const sweep_command& args) {
  const auto plan = experiments::load_sweep(args.file, args.set);
  const auto part = args.runs.part();
  auto how = args.runs.given(plan.name);
  if (args.runs.count) {
    std::cout << experiments::count_runs({&plan, 1}, how.program, interrupted)
              << '\n';
    return static_cast<int>(scenario::run_outcome::good);
  }
  experiments::making_progress progress;
  std::optional<network::http::server> server;
  if (!args.metrics.empty()) {
    how.watched = &progress;
    server.emplace(address_of(args.metrics),
                   [&progress](const network::http::request& asked) {
                     return page_of(progress, asked);
                   });
    std::cout << fmt::format("figures at http://{}/metrics\n",
                             network::print_address(server->address()))
              << std::flush;
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
  command
      ->add_option("--metrics", args->metrics,
                   "Serve how far it is, for Prometheus, and /healthz, by HTTP")
      ->type_name("ADDR:PORT")
      ->check(trouble_with_address);
  command->footer("Example:\n  sofof sweep config/paper/latency_plot.toml -j 2 "
                  "--out results/paper");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = obey(*args);
  });
}

} // namespace sofof::apps
