// The command-line arguments of everything that makes many runs.
#pragma once

#include "scenario/input_error.hpp"
#include "scenario/run.hpp"
#include "scenario/sweep/sweep.hpp"
#include "scenario/toml_file.hpp"
#include "world/fingerprint.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <malloc.h>
#include <memory>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace sofof {

struct sweep_arguments {
  std::string out;
  unsigned jobs = std::thread::hardware_concurrency();
  bool quiet = false;

  void add_to(CLI::App& command) {
    command
        .add_option("-j,--jobs", jobs,
                    "Runs at the same time (default: one per core)")
        ->type_name("N")
        ->check(CLI::Range(1U, 1024U));
    command
        .add_option("--out", out,
                    "Folder of all results (default results/NAME)")
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
    return all;
  }

private:
  /// Another build may give other results.
  static std::string this_program() {
    const auto text = read_text("/proc/self/exe");
    return fmt::format("{} {:016x}", SOFOF_VERSION,
                       fingerprint(text.value_or("")));
  }
};

} // namespace sofof
