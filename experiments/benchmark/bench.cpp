// A sweep for each scenario, a leaderboard of all.
#include "experiments/benchmark/bench.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/stopwatch.hpp"
#include "experiments/benchmark/board_page.hpp"
#include "experiments/benchmark/board_text.hpp"
#include "experiments/benchmark/criteria.hpp"
#include "experiments/benchmark/decision_costs.hpp"
#include "experiments/benchmark/leaderboard.hpp"
#include "experiments/dehler2025/sweep_results.hpp"
#include "experiments/report/html.hpp"
#include "scenario/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <ostream>
#include <string_view>
#include <system_error>
#include <utility>

namespace sofof::experiments::bench {

namespace {

namespace fs = std::filesystem;

constexpr auto board_name = "leaderboard";
constexpr auto timing_name = "timing";

/// @returns how each scenario is called in the results: as its file.
std::vector<std::string> names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> taken{board_name, timing_name}, names;
  for (const auto& file : files) {
    names.push_back(file.stem().string());
    if (std::ranges::find(taken, names.back()) != taken.end())
      throw input_error{fmt::format(
          "{}: the name \"{}\" is taken in the results; rename this file.",
          file.string(), names.back())};
    taken.push_back(names.back());
  }
  return names;
}

/// Who decides is what entrants differ in.
void refuse_policies(const std::vector<std::string>& set) {
  for (const auto& one : set)
    if (one.starts_with("policies.") || one.starts_with("policies="))
      throw input_error{fmt::format(
          "--set {}: each entrant sets the policies itself; write one with "
          "this option, in a file for --entrants or as [policies] of a "
          "scenario.",
          one)};
}

sweep_plan plan_of(const bench_options& options, std::string name,
                   const fs::path& scenario) {
  sweep_plan plan;
  plan.name = std::move(name);
  plan.scenario = scenario;
  // The figures that count are in the summary.
  plan.given = {"record.cycles=false", "record.tracks=false"};
  std::ranges::copy(options.set, std::back_inserter(plan.given));
  auto& axis = plan.axes.emplace_back();
  axis.name = "entrant";
  for (const auto& one : options.entrants)
    axis.values.push_back(one.as_value());
  plan.seeds.resize(options.seeds);
  std::iota(plan.seeds.begin(), plan.seeds.end(), 1);
  plan.measures = true; // decision times
  return plan;
}

/// A bench goes on where one was; it overwrites nothing else.
void refuse_foreign(const fs::path& out) {
  if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / "runs"))
    throw input_error{fmt::format(
        "{}: this folder holds something else than a bench; choose another "
        "one with --out.",
        out.string())};
}

class bench_at_work {
public:
  bench_at_work(const bench_options& options,
                const std::atomic<bool>& interrupted, std::ostream& console)
      : options_{options}, interrupted_{interrupted}, console_{console},
        plans_{plans_of(options)} {
    for (const auto& plan : plans_)
      expected_.scenarios.push_back(plan.name);
    expected_.seeds = options.seeds;
    for (const auto& one : options.entrants)
      expected_.entrants.push_back(one.name);
    for (const auto& file : options.scenarios) // before any run
      baselines_.push_back(
          baseline_of(scenario::load_scenario(file, options.set)));
  }

  bench_outcome carry_out() {
    refuse_foreign(options_.runs.out);
    remove_old();
    for (std::size_t i = 0; i < options_.scenarios.size(); ++i)
      if (!drive(i))
        return {.interrupted = true};
    compare_scores(judged_);
    std::vector<leaderboard> boards{rank(judged_, expected_, "")};
    for (const auto& scenario : expected_.scenarios)
      boards.push_back(rank(judged_, expected_, scenario));
    const auto costs = read_decision_costs(timed_);
    write_file(table(board_name), to_csv(boards, options_.entrants));
    write_file(table(timing_name), to_csv(costs));
    report::write_html(page_of(boards, costs), page(),
                       output_file::other_folder);
    console_ << board_text(boards.front(), costs, options_.colour);
    return {.all_good = all_good_};
  }

private:
  fs::path table(std::string_view name) const {
    return options_.runs.out / fmt::format("{}.csv", name);
  }
  fs::path page() const { return options_.runs.out / "report.html"; }

  /// An old ranking may be of others.
  void remove_old() const {
    std::error_code ignored;
    for (const auto& file : {table(board_name), table(timing_name), page()})
      fs::remove(file, ignored);
  }

  /// @returns whether it came to its end.
  bool drive(std::size_t number) {
    const stopwatch watch;
    const auto& plan = plans_[number];
    auto how = options_.runs;
    how.title = fmt::format("{} ({} of {})  ", plan.name, number + 1,
                            options_.scenarios.size());
    const auto outcome = sweep(plan, how, interrupted_, console_);
    if (outcome.interrupted)
      return false;
    all_good_ &= outcome.all_good();
    const auto runs = study::runs_of(plan, outcome);
    for (const auto& run : runs) {
      judged_.push_back(judge(run, baselines_[number]));
      judged_.back().scenario = plan.name;
    }
    for (const auto& entrant : expected_.entrants) {
      auto& timed = timed_.emplace_back(timed_runs{entrant, plan.name, {}});
      for (const auto* run : study::those(runs, 0, entrant))
        timed.folders.push_back(run->folder);
    }
    if (how.show != recording::progress::output::quiet)
      console_ << fmt::format("{}: {} runs, {}\n", plan.name, runs.size(),
                              recording::for_people(watch.elapsed_s()))
               << std::flush;
    return true;
  }

  report::document page_of(std::span<const leaderboard> boards,
                           std::span<const decision_cost> costs) const {
    return board_page(
        boards, costs, options_.entrants,
        fmt::format("{} run{} of each in every scenario, the same noise for "
                    "all. sofof {}.",
                    options_.seeds, options_.seeds == 1 ? "" : "s",
                    options_.runs.program));
  }

  const bench_options& options_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  std::vector<sweep_plan> plans_; ///< One for each scenario.
  expected_runs expected_;
  std::vector<baseline> baselines_; ///< One for each scenario.
  std::vector<judged_run> judged_;
  std::vector<timed_runs> timed_;
  bool all_good_ = true;
};

} // namespace

std::vector<sweep_plan> plans_of(const bench_options& options) {
  assert(!options.scenarios.empty() && !options.entrants.empty());
  assert(options.seeds >= 1);
  refuse_policies(options.set);
  const auto names = names_of(options.scenarios);
  std::vector<sweep_plan> plans;
  for (std::size_t i = 0; i < names.size(); ++i)
    plans.push_back(plan_of(options, names[i], options.scenarios[i]));
  return plans;
}

shard_outcome bench_shard(const bench_options& options, const shard& which,
                          const std::atomic<bool>& interrupted,
                          std::ostream& console) {
  const auto plans = plans_of(options);
  refuse_foreign(options.runs.out);
  return make_shard(plans, options.runs, which, interrupted, console);
}

bench_outcome bench(const bench_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  return bench_at_work{options, interrupted, console}.carry_out();
}

} // namespace sofof::experiments::bench
