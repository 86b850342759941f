// The command-line arguments of everything that makes many runs.
#pragma once

#include "apps/program.hpp"
#include "scenario/run.hpp"
#include "scenario/sweep/sweep.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <malloc.h>
#include <string>
#include <thread>
#include <unistd.h>

namespace sofof {

struct sweep_arguments {
  std::string out;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  bool quiet = false;

  void add_to(CLI::App& command) {
    command
        .add_option("-j,--jobs", jobs,
                    "Runs at the same time (default: one per core)")
        ->type_name("N")
        ->check(CLI::Range(1U, 1024U));
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
    all.make = virtual_runs(SOFOF_VERSION);
    all.jobs = jobs;
    return all;
  }
};

} // namespace sofof
