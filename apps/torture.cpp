// sofof torture: scenarios with faults, made up of seeds, held to all promises.
#include "experiments/torture/torture.hpp"

#include "apps/command.hpp"
#include "apps/program.hpp"
#include "apps/signals.hpp"
#include "base/input_error.hpp"
#include "experiments/torture/draw.hpp"
#include "scenario/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace sofof::apps {

namespace {

using experiments::torture::torture_options;
using experiments::torture::torture_outcome;

constexpr double usual_hours = 1;

struct torture_arguments {
  std::string file;
  std::string out = "results/torture";
  std::optional<std::uint64_t> seed;
  std::optional<std::string> seeds, part;
  std::string with;
  std::optional<double> hours;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  bool print = false, quiet = false;

  /// @returns "A-B" as two numbers.
  static std::pair<std::uint64_t, std::uint64_t>
  range_of(const std::string& text) {
    std::uint64_t first = 0, last = 0;
    const auto* end = text.data() + text.size();
    const auto a = std::from_chars(text.data(), end, first);
    if (a.ec == std::errc{} && a.ptr != end && *a.ptr == '-') {
      const auto b = std::from_chars(a.ptr + 1, end, last);
      if (b.ec == std::errc{} && b.ptr == end && first <= last)
        return {first, last};
    }
    throw input_error{fmt::format("--seeds {}: it must be A-B, from seed A to "
                                  "seed B, like --seeds 1-100.",
                                  text)};
  }

  torture_options given() const {
    torture_options all;
    all.out = out;
    all.program = this_program();
    all.jobs = jobs;
    // A scenario's seed is a number of 63 bits.
    all.last = std::numeric_limits<std::int64_t>::max();
    if (seed) {
      all.first = all.last = *seed;
      all.again = true;
    } else if (seeds)
      std::tie(all.first, all.last) = range_of(*seeds);
    if (part) {
      all.part = experiments::parse_shard(*part);
      if (!all.part)
        throw input_error{fmt::format("--shard {}: it must be I/N, shard I of "
                                      "N, like --shard 2/7.",
                                      *part)};
    }
    all.with = with;
    all.hours = hours;
    if (!hours && !seed && !seeds)
      all.hours = usual_hours;
    if (!quiet)
      all.show = isatty(STDOUT_FILENO) != 0
                     ? recording::progress::output::terminal
                     : recording::progress::output::plain;
    return all;
  }

  int obey() const {
    if (print) {
      std::cout << experiments::torture::draw(seed.value());
      return static_cast<int>(scenario::run_outcome::good);
    }
    const auto done =
        file.empty()
            ? experiments::torture::try_seeds(given(), interrupted, std::cout)
            : experiments::torture::try_scenario({require_text(file), file},
                                                 out, std::cout);
    if (done.interrupted) {
      std::cout << "interrupted; the same command goes on from here\n";
      return static_cast<int>(scenario::run_outcome::interrupted);
    }
    return static_cast<int>(done.findings == 0 ? scenario::run_outcome::good
                                               : scenario::run_outcome::failed);
  }
};

} // namespace

void add_torture(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "torture", "Look for broken promises: drives with faults, by seeds");
  auto args = std::make_shared<torture_arguments>();
  auto* file = command
                   ->add_option("FILE", args->file,
                                "Try this scenario instead of drawn ones")
                   ->type_name(" ");
  auto* seed =
      command
          ->add_option("--seed", args->seed, "Try this one, again if need be")
          ->type_name("N");
  auto* seeds =
      command->add_option("--seeds", args->seeds, "Try these (default 1 on)")
          ->type_name("A-B");
  auto* hours =
      command
          ->add_option("--hours", args->hours,
                       "Until the log has so many hours of vehicles (default "
                       "1, unless seeds are given)")
          ->type_name("H")
          ->check(CLI::Range(0.0, 1e9));
  auto* part =
      command
          ->add_option("--shard", args->part, "Only the seeds of shard I of N")
          ->type_name("I/N");
  auto* with = command
                   ->add_option("--with", args->with,
                                "Only seeds whose scenario has these words, "
                                "like \"tracking\"")
                   ->type_name("WORDS");
  seed->excludes(seeds)->excludes(hours)->excludes(part)->excludes(with);
  file->excludes(seed)->excludes(seeds)->excludes(hours)->excludes(part);
  file->excludes(with);
  command
      ->add_option("-j,--jobs", args->jobs,
                   "Runs at the same time (default: one per core)")
      ->type_name("N")
      ->check(CLI::Range(1U, 1024U));
  command
      ->add_option("--out", args->out,
                   "Folder of the log of seeds and of findings (default "
                   "results/torture)")
      ->type_name("DIR");
  command
      ->add_flag("--print", args->print,
                 "Print the scenario of --seed, and try nothing")
      ->needs(seed);
  command->add_flag("--quiet", args->quiet, "No progress");
  command->footer("Example:\n  sofof torture --hours 500 --shard 1/4");
  command->callback([args, &exit_code] {
    catch_signals();
    exit_code = args->obey();
  });
}

} // namespace sofof::apps
