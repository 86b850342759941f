// A sweep for each scenario, a leaderboard of all.
#include "scenario/bench/bench.hpp"

#include "scenario/bench/board_page.hpp"
#include "scenario/bench/board_text.hpp"
#include "scenario/bench/criteria.hpp"
#include "scenario/bench/decision_costs.hpp"
#include "scenario/bench/leaderboard.hpp"
#include "scenario/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/output_file.hpp"
#include "scenario/report/html.hpp"
#include "scenario/stopwatch.hpp"
#include "scenario/study/swept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <ostream>
#include <string_view>
#include <system_error>

namespace sofof::bench {

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

class bench_at_work {
public:
  bench_at_work(const bench_options& options,
                const std::atomic<bool>& interrupted, std::ostream& console)
      : options_{options}, interrupted_{interrupted}, console_{console} {
    refuse_policies(options.set);
    expected_.scenarios = names_of(options.scenarios);
    expected_.seeds = options.seeds;
    for (const auto& one : options.entrants)
      expected_.entrants.push_back(one.name);
    for (const auto& file : options.scenarios) // before any run
      yardsticks_.push_back(yardstick_of(load_scenario(file, options.set)));
  }

  bench_outcome carry_out() {
    refuse_foreign();
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

  /// A bench goes on where one was; it overwrites nothing else.
  void refuse_foreign() const {
    const auto& out = options_.runs.out;
    if (fs::exists(out) && !fs::is_empty(out) && !fs::exists(out / "runs"))
      throw input_error{fmt::format(
          "{}: this folder holds something else than a bench; choose another "
          "one with --out.",
          out.string())};
  }

  /// An old ranking may be of others.
  void remove_old() const {
    std::error_code ignored;
    for (const auto& file : {table(board_name), table(timing_name), page()})
      fs::remove(file, ignored);
  }

  sweep_plan plan_of(std::size_t number) const {
    sweep_plan plan;
    plan.name = expected_.scenarios[number];
    plan.scenario = options_.scenarios[number];
    // The figures that count are in the summary.
    plan.given = {"record.cycles=false", "record.tracks=false"};
    std::ranges::copy(options_.set, std::back_inserter(plan.given));
    auto& axis = plan.axes.emplace_back();
    axis.name = "entrant";
    for (const auto& one : options_.entrants)
      axis.values.push_back(one.as_value());
    plan.seeds.resize(options_.seeds);
    std::iota(plan.seeds.begin(), plan.seeds.end(), 1);
    return plan;
  }

  /// @returns whether it came to its end.
  bool drive(std::size_t number) {
    const stopwatch watch;
    const auto plan = plan_of(number);
    auto how = options_.runs;
    how.title = fmt::format("{} ({} of {})  ", plan.name, number + 1,
                            options_.scenarios.size());
    const auto outcome = sweep(plan, how, interrupted_, console_);
    if (outcome.interrupted)
      return false;
    all_good_ &= outcome.all_good();
    const auto runs = study::runs_of(plan, outcome);
    for (const auto& run : runs) {
      judged_.push_back(judge(run, yardsticks_[number]));
      judged_.back().scenario = plan.name;
    }
    for (const auto& entrant : expected_.entrants) {
      auto& timed = timed_.emplace_back(timed_runs{entrant, plan.name, {}});
      for (const auto* run : study::those(runs, 0, entrant))
        timed.folders.push_back(run->folder);
    }
    if (how.show != progress::output::quiet)
      console_ << fmt::format("{}: {} runs, {}\n", plan.name, runs.size(),
                              for_people(watch.elapsed_s()))
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
  expected_runs expected_;
  std::vector<yardstick> yardsticks_; ///< One for each scenario.
  std::vector<judged_run> judged_;
  std::vector<timed_runs> timed_;
  bool all_good_ = true;
};

} // namespace

bench_outcome bench(const bench_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  return bench_at_work{options, interrupted, console}.carry_out();
}

} // namespace sofof::bench
