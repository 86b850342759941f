// sofof run: drives a scenario.
#include "scenario/run.hpp"

#include "apps/command.hpp"
#include "apps/run_arguments.hpp"
#include "apps/signals.hpp"

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <sched.h>

namespace sofof::apps {

namespace {

/// @returns how many cores this process may use.
std::size_t own_cores() {
  cpu_set_t mine;
  if (sched_getaffinity(0, sizeof mine, &mine) != 0)
    return 1;
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&mine)));
}

} // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "Drive a scenario");
  auto args = std::make_shared<run_arguments>();
  args->add_to(*command);
  command->add_flag("--realtime", args->options.realtime,
                    "Run on the wall clock instead of in virtual time");
  command->add_flag("--cpu", args->options.cpu,
                    "With --realtime: keep accounts of who computes how much");
  const auto threads = std::make_shared<std::optional<std::size_t>>();
  command
      ->add_option("--threads", *threads,
                   "Compute plans on so many threads (default: one per core); "
                   "results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->footer("Example:\n  sofof run config/ulm_lehr.toml --seed 7 "
                  "--duration 1800s --out results/seven");
  command->callback([args, threads, &exit_code] {
    args->options.threads =
        threads->value_or(args->options.realtime ? 1 : own_cores());
    const auto s = args->what.load();
    catch_signals();
    exit_code = static_cast<int>(
        scenario::run(s, args->given(), interrupted, std::cout));
  });
}

} // namespace sofof::apps
