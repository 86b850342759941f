// Sweeps, wall-clock runs, a report.
#include "experiments/dehler2025/reproduce.hpp"

#include "base/files/output_file.hpp"
#include "base/options/toml_text.hpp"
#include "base/stopwatch.hpp"
#include "experiments/dehler2025/cpu_run.hpp"
#include "experiments/dehler2025/effort.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "experiments/dehler2025/seed_rounds.hpp"
#include "experiments/dehler2025/sweep_results.hpp"
#include "experiments/dehler2025/verdicts.hpp"
#include "experiments/report/html.hpp"
#include "experiments/report/markdown.hpp"

#include <fmt/format.h>

#include <ostream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sofof::experiments::study {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view sweeps[] = {
    "latency_plot", "delay_plot", "in_area",    "apart",
    "stalls",       "real_world", "quality",    "refusals",
    "host",         "correlated", "loaded_host"};

seed_rule rule_of(const reproduction_options& options) {
  return options.full ? full_rule : seed_rule{};
}

/// Each sweep as its file has it.
std::vector<sweep_plan> first_plans(const reproduction_options& options) {
  std::vector<std::string> given;
  if (!options.trace.empty())
    given = {"network.profile=\"trace\"",
             fmt::format("network.trace={}",
                         quoted_toml(fs::absolute(options.trace).string()))};
  std::vector<sweep_plan> plans;
  for (const auto name : sweeps)
    plans.push_back(
        load_sweep(options.sweeps / fmt::format("{}.toml", name), given));
  return plans;
}

/// Thrown to get out of the middle of a reproduction.
struct interruption {};

/// How often computing time is measured at each rate: no two are alike.
constexpr std::size_t cpu_runs_of_a_rate = 5;

/// First those at 20 Hz, then those at 100 Hz.
std::vector<cpu_run> cpu_runs(const reproduction_options& options) {
  std::vector<cpu_run> runs;
  for (const auto* name : {"cpu_20_hz", "cpu_100_hz"})
    for (std::size_t seed = 1; seed <= cpu_runs_of_a_rate; ++seed) {
      auto& run = runs.emplace_back(cpu_run{fmt::format("{}-{}", name, seed),
                                            options.sweeps / "cpu.toml",
                                            {fmt::format("seed={}", seed)},
                                            options.runs.program,
                                            options.version});
      if (name == std::string_view{"cpu_100_hz"})
        run.given.emplace_back("service.0.period=10ms");
    }
  return runs;
}

void say(const reproduction_options& options, std::ostream& console,
         const std::string& line) {
  if (options.runs.show != recording::progress::output::quiet)
    console << line << std::endl;
}

/// @returns their folders.
/// @throws interruption.
std::vector<std::filesystem::path>
make_cpu_runs(const reproduction_options& options,
              const std::atomic<bool>& interrupted, std::ostream& console) {
  const run_store store{options.runs.out};
  std::vector<std::filesystem::path> folders;
  for (const auto& which : cpu_runs(options)) {
    const stopwatch watch;
    folders.push_back(make_cpu_run(which, store, interrupted));
    if (interrupted)
      throw interruption{};
    say(options, console,
        fmt::format("{}: {} on the wall's clock", which.name,
                    recording::for_people(watch.elapsed_s())));
  }
  return folders;
}

class reproduction {
public:
  reproduction(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console)
      : options_{options}, interrupted_{interrupted}, console_{console},
        plans_{first_plans(options)} {}

  paper_runs gather() {
    paper_runs e;
    e.latency_plot = next_runs();
    e.delay_plot = next_runs();
    e.in_area = next_runs();
    e.apart = next_runs();
    e.stalls = next_runs();
    e.real_world = next_runs();
    e.quality = next_runs();
    e.refusals = next_runs();
    e.host = next_runs();
    e.correlated = next_runs();
    e.loaded_host = next_runs();
    // Nothing else computes meanwhile.
    const auto folders = make_cpu_runs(options_, interrupted_, console_);
    const std::span all{folders};
    e.cpu_20_hz = read_cpu_runs(all.first(cpu_runs_of_a_rate));
    e.cpu_100_hz = read_cpu_runs(all.last(cpu_runs_of_a_rate));
    return e;
  }

private:
  /// The runs of the next plan, in as many rounds as it needs.
  std::vector<measured_run> next_runs() {
    const stopwatch watch;
    auto plan = plans_.at(begun_++);
    auto runs = one_round(plan);
    while (add_seeds(plan, runs, rule_of(options_)))
      runs = one_round(plan);
    say(options_, console_,
        fmt::format("{}: {} runs, {}", plan.name, runs.size(),
                    recording::for_people(watch.elapsed_s())));
    return runs;
  }

  std::vector<measured_run> one_round(const sweep_plan& plan) {
    auto how = options_.runs;
    how.title =
        fmt::format("{} ({} of {})  ", plan.name, begun_, plans_.size());
    const auto outcome = sweep(plan, how, interrupted_, console_);
    if (outcome.interrupted)
      throw interruption{};
    if (!outcome.all_good())
      throw std::runtime_error{fmt::format(
          "{} runs of {} failed and {} were unsafe: {} says which.",
          outcome.failed, plan.name, outcome.unsafe, outcome.table.string())};
    return study::runs_of(plan, outcome);
  }

  const reproduction_options& options_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  std::vector<sweep_plan> plans_;
  std::size_t begun_ = 0;
};

} // namespace

std::vector<sweep_plan> next_plans(const reproduction_options& options,
                                   const std::atomic<bool>& interrupted) {
  std::vector<sweep_plan> plans;
  for (auto& plan : first_plans(options))
    plans.push_back(next_round(std::move(plan), options.runs, rule_of(options),
                               interrupted));
  return plans;
}

shard_outcome reproduce_shard(const reproduction_options& options,
                              const shard& which,
                              const std::atomic<bool>& interrupted,
                              std::ostream& console) {
  auto outcome = make_shard(next_plans(options, interrupted), options.runs,
                            which, interrupted, console);
  if (which.number == measuring_shard && !outcome.interrupted)
    try {
      make_cpu_runs(options, interrupted, console);
    } catch (const interruption&) {
      outcome.interrupted = true;
    }
  return outcome;
}

bool reproduce(const reproduction_options& options,
               const std::atomic<bool>& interrupted, std::ostream& console) {
  try {
    if (options.full)
      say(options, console,
          text_of(longest_effort(first_plans(options), options.runs,
                                 rule_of(options), interrupted, console)));
    const auto e = reproduction{options, interrupted, console}.gather();
    report::document all;
    all.title = "The paper's evaluation, reproduced";
    all.subtitle = report_text::of("report").fill(
        "subtitle", {{"version", options.version}});
    if (!options.trace.empty())
      all.subtitle += ' '
                      + report_text::of("report").fill(
                          "trace", {{"trace", options.trace.string()}});
    all.sections = {verdicts(judge(figures_of(e))),
                    latency_plot(e),
                    delay_plot(e),
                    sensitivity(e),
                    refusals(e),
                    real_world(e),
                    cpu_cost(e),
                    quality(e)};
    write_file(options.runs.out / "reproduction.md", report::markdown(all));
    report::write_html(all, options.runs.out / "report.html");
  } catch (const interruption&) {
    return false;
  }
  return true;
}

} // namespace sofof::experiments::study
