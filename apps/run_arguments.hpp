// The command-line arguments of everything that runs a scenario.
#pragma once

#include "apps/address_argument.hpp"
#include "apps/scenario_arguments.hpp"
#include "scenario/run.hpp"

#include "live/shown_at.hpp"
#include <string>
#include <unistd.h>

namespace sofof::apps {

/// Where a live page is if nobody says where.
inline const network::network_address any_port{"127.0.0.1", 0};

/// @returns what is wrong with a word behind --live; else nothing.
inline std::string trouble_with_live(const std::string& text) {
  if (text.empty() || network::parse_address(text))
    return "";
  return fmt::format("'{}' is no HOST:PORT, like 127.0.0.1:9465; an address "
                     "may follow --live, so write files before it",
                     text);
}

struct run_arguments {
  scenario_arguments what;
  scenario::run_options options;
  std::string out;
  std::string metrics, live_at, udp, udp_from;
  CLI::Option* live = nullptr;
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
    live = command
               .add_option("--live", live_at,
                           "Show it in browsers while it goes on, and serve "
                           "figures; on the wall clock only (default "
                           "127.0.0.1:0, any port of this machine)")
               ->type_name("[ADDR:PORT]")
               ->expected(0, 1)
               ->check(trouble_with_live);
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
    if (live->count() > 0)
      all.live =
          live::shown_at(live_at.empty() ? any_port : address_of(live_at));
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
