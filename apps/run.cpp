// sofof run: drives a scenario.
#include "scenario/run.hpp"

#include "apps/command.hpp"
#include "apps/scenario_arguments.hpp"

#include <atomic>
#include <csignal>
#include <iostream>
#include <memory>
#include <unistd.h>

namespace sofof {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal ends the run in good order, a second one at once.
void catch_signals() {
  auto on_signal = [](int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

struct arguments {
  scenario_arguments what;
  run_options options;
  std::string out;
  bool quiet = false;
};

int run_command(arguments& args) {
  const auto s = args.what.load();
  auto& options = args.options;
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  if (!args.out.empty())
    options.out = args.out;
  if (!args.quiet)
    options.show =
        terminal ? progress::output::terminal : progress::output::plain;
  options.colour = terminal;
  options.version = SOFOF_VERSION;
  catch_signals();
  return static_cast<int>(run(s, options, interrupted, std::cout));
}

} // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "Drive a scenario");
  auto args = std::make_shared<arguments>();
  args->what.add_to(*command);
  command
      ->add_option("--out", args->out,
                   "Results folder (default results/<scenario>-<seed>)")
      ->type_name("DIR");
  command
      ->add_option("--pcap", args->options.pcap,
                   "Capture all CAMs, CPMs and MCMs, for Wireshark")
      ->type_name("FILE")
      ->check([](const std::string& file) {
        return std::string{file.empty() ? "a file's name is expected" : ""};
      });
  command->add_flag("--force", args->options.force,
                    "Write into a folder that is not empty");
  command->add_flag("--realtime", args->options.realtime,
                    "Run on the wall clock instead of in virtual time");
  command->add_flag("--quiet", args->quiet, "No progress, no table");
  command->footer("Example:\n  sofof run config/ulm_lehr.toml --seed 7 "
                  "--duration 1800s --out results/seven");
  command->callback([args, &exit_code] { exit_code = run_command(*args); });
}

} // namespace sofof
