// The command-line arguments of everything that runs a scenario.
#pragma once

#include "apps/address_argument.hpp"
#include "apps/scenario_arguments.hpp"
#include "scenario/run.hpp"

#include <string>
#include <unistd.h>

namespace sofof::apps {

struct run_arguments {
  scenario_arguments what;
  scenario::run_options options;
  std::string out;
  std::string metrics, udp, udp_from;
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
    command
        .add_option("--metrics", metrics,
                    "Serve figures for Prometheus, and /healthz, by HTTP; on "
                    "the wall clock only")
        ->type_name("ADDR:PORT")
        ->check(trouble_with_address);
    auto* to = command
                   .add_option("--udp", udp,
                               "Send CAMs, CPMs and MCMs there as datagrams, "
                               "BTP header and message; on the wall clock only")
                   ->type_name("ADDR:PORT")
                   ->check(trouble_with_address);
    command
        .add_option("--udp-from", udp_from,
                    "Hear such datagrams of others here")
        ->type_name("ADDR:PORT")
        ->check(trouble_with_address)
        ->needs(to);
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
    if (!metrics.empty())
      all.metrics = address_of(metrics);
    if (!udp.empty())
      all.udp = {address_of(udp), {}};
    if (!udp_from.empty())
      all.udp->from = address_of(udp_from);
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
