// sofof run: drives a scenario.
#include "scenario/run.hpp"

#include "apps/command.hpp"
#include "apps/run_arguments.hpp"
#include "apps/signals.hpp"

#include <iostream>
#include <memory>

namespace sofof::apps {

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "Drive a scenario");
  auto args = std::make_shared<run_arguments>();
  args->add_to(*command);
  command->add_flag("--realtime", args->options.realtime,
                    "Run on the wall clock instead of in virtual time");
  command->add_flag("--cpu", args->options.cpu,
                    "With --realtime: keep accounts of who computes how much");
  command->footer("Example:\n  sofof run config/ulm_lehr.toml --seed 7 "
                  "--duration 1800s --out results/seven");
  command->callback([args, &exit_code] {
    const auto s = args->what.load();
    catch_signals();
    exit_code = static_cast<int>(
        scenario::run(s, args->given(), interrupted, std::cout));
  });
}

} // namespace sofof::apps
