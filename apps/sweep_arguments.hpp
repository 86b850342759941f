// The command-line arguments of everything that makes many runs.
#pragma once

#include "apps/program.hpp"
#include "base/input_error.hpp"
#include "experiments/sweep/sharded_sweep.hpp"
#include "scenario/run.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <malloc.h>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace sofof::apps {

struct sweep_arguments {
  std::string out;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::optional<std::string> part_text;
  bool count = false;
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
    command
        .add_option("--shard", part_text,
                    "Make only the runs of shard I of N, which may share a "
                    "folder")
        ->type_name("I/N");
    command.add_flag("--count", count,
                     "Print how many runs there are to share out, and end");
    command.add_flag("--quiet", quiet, "No progress");
  }

  /// @param name  Of the results, if no folder was given.
  experiments::sweep_options given(const std::string& name) const {
    // Each thread has a world of its own, so each gets memory of its own.
    mallopt(M_ARENA_MAX, static_cast<int>(jobs) + 1);
    experiments::sweep_options all;
    all.out = out.empty() ? "results/" + name : out;
    all.program = this_program();
    if (!quiet)
      all.show = isatty(STDOUT_FILENO) != 0
                     ? recording::progress::output::terminal
                     : recording::progress::output::plain;
    all.make = experiments::virtual_runs(SOFOF_VERSION);
    all.jobs = jobs;
    return all;
  }

  /// @returns the shard that is asked for, if any.
  /// @throws input_error for one that there cannot be, or beside --count.
  std::optional<experiments::shard> part() const {
    if (!part_text)
      return std::nullopt;
    if (count)
      throw input_error{"--count counts the runs of all shards; leave --shard "
                        "out."};
    const auto which = experiments::parse_shard(*part_text);
    if (!which)
      throw input_error{fmt::format(
          "--shard {}: it must be I/N, shard I of N, with whole numbers, "
          "1 <= I <= N <= {}; like --shard 2/7.",
          *part_text, experiments::most_shards)};
    return which;
  }
};

/// Says what a shard did, and what to do next.
/// @param result  What the whole command writes, for people.
/// @returns the exit code.
inline int tell_shard(const experiments::shard_outcome& done,
                      const experiments::shard& which,
                      std::string_view result) {
  if (done.interrupted) {
    std::cout << "interrupted; the same command goes on from here\n";
    return static_cast<int>(scenario::run_outcome::interrupted);
  }
  std::cout << fmt::format(
      "shard {} of {}: {} of {} runs, {} from before; {} good, {} unsafe, {} "
      "failed\nonce all shards have ended, the same command without --shard "
      "writes {}\n",
      which.number, which.of, done.all(), done.of_all, done.found, done.good,
      done.unsafe, done.failed, result);
  return static_cast<int>(done.all_good() ? scenario::run_outcome::good
                                          : scenario::run_outcome::failed);
}

} // namespace sofof::apps
