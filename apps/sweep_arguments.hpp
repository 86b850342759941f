// The command-line arguments of everything that makes many runs.
#pragma once

#include "apps/host_arguments.hpp"
#include "apps/program.hpp"
#include "scenario/input_error.hpp"
#include "scenario/sweep/far_site.hpp"
#include "scenario/sweep/sweep.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <malloc.h>
#include <memory>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace sofof {

struct sweep_arguments {
  std::string out;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::string> workers;
  host_arguments host;
  bool quiet = false;

  void add_to(CLI::App& command) {
    command
        .add_option("-j,--jobs", jobs,
                    "Runs at the same time on this host (default: one per "
                    "core; 0: none)")
        ->type_name("N")
        ->check(CLI::Range(0U, 1024U));
    command
        .add_option("--workers", workers,
                    "Hosts that carry out runs as well, see `sofof worker`")
        ->type_name("HOST:PORT,...")
        ->delimiter(',');
    host.add_to(command);
    command
        .add_option("--out", out, "Folder of all results (default in results/)")
        ->type_name("DIR");
    command.add_flag("--quiet", quiet, "No progress");
  }

  /// @param name  Of the results, if no folder was given.
  sweep_options given(const std::string& name) const {
    // Each thread has a world of its own, so each gets memory of its own.
    mallopt(M_ARENA_MAX, static_cast<int>(jobs) + 1);
    sweep_options all;
    all.out = out.empty() ? "results/" + name : out;
    all.program = this_program();
    if (!quiet)
      all.show = isatty(STDOUT_FILENO) != 0 ? progress::output::terminal
                                            : progress::output::plain;
    for (unsigned i = 0; i < jobs; ++i)
      all.sites.push_back(std::make_shared<own_site>(SOFOF_VERSION));
    if (jobs == 0 && workers.empty())
      throw input_error("-j 0 leaves nobody to carry out runs; name hosts that "
                        "do with --workers");
    if (!workers.empty())
      std::ranges::move(connect_to_workers(far_ones(all.program)),
                        std::back_inserter(all.sites));
    return all;
  }

private:
  far_site_options far_ones(const std::string& program) const {
    far_site_options what;
    host.give(what);
    what.program = program;
    for (const auto& text : workers)
      what.workers.push_back(address_of(text));
    return what;
  }
};

} // namespace sofof
