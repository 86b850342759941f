// The command-line arguments of everything that runs a scenario.
#pragma once

#include "apps/scenario_arguments.hpp"
#include "scenario/run.hpp"

#include <string>
#include <unistd.h>

namespace sofof::apps {

struct run_arguments {
  scenario_arguments what;
  scenario::run_options options;
  std::string out;
  bool quiet = false;

  void add_to(CLI::App& command) {
    what.add_to(command);
    command
        .add_option("--out", out,
                    "Results folder (default one of its own in results/)")
        ->type_name("DIR");
    command
        .add_option("--pcap", options.pcap,
                    "Capture all CAMs, CPMs and MCMs, for Wireshark")
        ->type_name("FILE")
        ->check([](const std::string& file) {
          return std::string{file.empty() ? "a file's name is expected" : ""};
        });
    command.add_flag("--force", options.force,
                     "Write into a folder that is not empty");
    command.add_flag("--quiet", quiet, "No progress, no table");
  }

  /// @returns the options as they were given, for a console on stdout.
  scenario::run_options given() const {
    auto all = options;
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    if (!out.empty())
      all.out = out;
    if (!quiet)
      all.show = terminal ? recording::progress::output::terminal
                          : recording::progress::output::plain;
    all.colour = terminal;
    all.changes = what.set;
    all.version = SOFOF_VERSION;
    return all;
  }
};

} // namespace sofof::apps
