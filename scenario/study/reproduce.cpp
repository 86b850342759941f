// Sweeps, wall-clock runs, a report.
#include "scenario/study/reproduce.hpp"

#include "scenario/load.hpp"
#include "scenario/output_file.hpp"
#include "scenario/report/html.hpp"
#include "scenario/report/markdown.hpp"
#include "scenario/run.hpp"
#include "scenario/stopwatch.hpp"
#include "scenario/study/sections.hpp"
#include "scenario/study/swept.hpp"
#include "scenario/sweep/sweep.hpp"

#include <fmt/format.h>

#include <ostream>
#include <stdexcept>

namespace sofof::study {

namespace {

/// Thrown to get out of the middle of a reproduction.
struct interruption {};

class reproduction {
public:
  reproduction(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console)
      : options_{options}, interrupted_{interrupted}, console_{console} {}

  evidence gather() {
    evidence e;
    e.latency_plot = runs_of("latency_plot");
    e.delay_plot = runs_of("delay_plot");
    e.in_area = runs_of("in_area");
    e.apart = runs_of("apart");
    e.stalls = runs_of("stalls");
    e.real_world = runs_of("real_world");
    e.quality = runs_of("quality");
    // Nobody else computes meanwhile.
    e.cpu_20_hz = computing_time("cpu_20_hz", {});
    e.cpu_100_hz = computing_time("cpu_100_hz", {"service.0.period=10ms"});
    return e;
  }

private:
  void say(const std::string& line) {
    if (options_.show != progress::output::quiet)
      console_ << line << std::endl;
  }

  std::vector<measured_run> runs_of(const std::string& name) {
    const stopwatch watch;
    const auto plan = load_sweep(options_.sweeps / (name + ".toml"));
    sweep_options how;
    how.out = options_.out;
    how.program = options_.program;
    how.show = options_.show;
    how.title = fmt::format("{} ({} of {})  ", name, ++begun_, sweeps);
    how.make = options_.make;
    how.jobs = options_.jobs;
    const auto outcome = sweep(plan, how, interrupted_, console_);
    if (outcome.interrupted)
      throw interruption{};
    if (!outcome.all_good())
      throw std::runtime_error{fmt::format(
          "{} runs of {} failed and {} were unsafe: {} says which.",
          outcome.failed, name, outcome.unsafe, outcome.table.string())};
    auto runs = study::runs_of(plan, outcome);
    say(fmt::format("{}: {} runs, {}", name, runs.size(),
                    for_people(watch.elapsed_s())));
    return runs;
  }

  measured_cpu computing_time(const std::string& name,
                              const std::vector<std::string>& given) {
    const auto s = load_scenario(options_.sweeps / "cpu.toml", given);
    std::optional<cpu_table> measured;
    run_options how;
    how.out = options_.out / name;
    how.force = true;
    how.realtime = true;
    how.cpu = true;
    how.on_cpu = [&measured](const cpu_table& x) { measured = x; };
    how.version = options_.version;
    std::ostream nowhere{nullptr};
    const auto outcome = run(s, how, interrupted_, nowhere);
    if (outcome == run_outcome::interrupted)
      throw interruption{};
    if (outcome == run_outcome::failed)
      throw std::runtime_error{fmt::format(
          "the run in {} was unsafe, summary.json says how; it needs an idle "
          "machine, its clock is the wall's.",
          how.out->string())};
    say(fmt::format("{}: {:.0f} s on the wall's clock", name,
                    to_seconds(s.length)));
    const auto figures =
        measured ? figures_of(*measured, planning) : std::nullopt;
    if (!figures)
      throw std::runtime_error{fmt::format(
          "no vehicle in {} was both local and offloaded.", how.out->string())};
    const auto drove = read_run({}, *how.out);
    return {*figures, drove.figure("driving.distance_m")
                          / drove.figure("safety.driven_s")};
  }

  const reproduction_options& options_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  static constexpr int sweeps = 7;
  int begun_ = 0;
};

} // namespace

bool reproduce(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console) {
  try {
    const auto e = reproduction{options, interrupted, console}.gather();
    report::document all;
    all.title = "The paper's evaluation, reproduced";
    all.subtitle = fmt::format(
        "R. Dehler, M. Buchholz, IEEE RA-L 10(5), 2025, doi "
        "10.1109/LRA.2025.3555939, by SOFOF {}. `sofof reproduce` makes this "
        "again; docs/results.md says what figures count, docs/channels.md what "
        "the channels are.",
        options.version);
    all.sections = {latency_plot(e), delay_plot(e), real_world(e), cpu_cost(e),
                    quality(e)};
    write_file(options.out / "reproduction.md", report::markdown(all));
    report::write_html(all, options.out / "report.html");
  } catch (const interruption&) {
    return false;
  }
  return true;
}

} // namespace sofof::study
