// The runs of all plans, and a shard's part of them.
#include "experiments/sweep/sharded_sweep.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <ostream>
#include <set>
#include <utility>

namespace sofof::experiments {

namespace {

/// @returns what all plans want together, each run once.
wanted_runs runs_wanted_by_all(std::span<const sweep_plan> plans,
                               std::string_view program,
                               const std::atomic<bool>& interrupted) {
  wanted_runs all;
  std::set<std::string> met;
  for (const auto& plan : plans) {
    auto own = runs_wanted_by(plan, program, interrupted);
    for (auto& run : own.runs)
      if (met.insert(run.name).second)
        all.runs.push_back(std::move(run));
    std::ranges::move(own.problems, std::back_inserter(all.problems));
  }
  return all;
}

} // namespace

shard_outcome make_shard(std::span<const sweep_plan> plans,
                         const sweep_options& options, const shard& which,
                         const std::atomic<bool>& interrupted,
                         std::ostream& console) {
  assert(which.number >= 1 && which.number <= which.of);
  auto all = runs_wanted_by_all(plans, options.program, interrupted);
  for (const auto& run : all.runs)
    if (run.unrepeatable)
      throw input_error{*run.unrepeatable};
  const auto shard_of = share_out(all.runs, which.of);
  std::vector<wanted_run> own;
  for (std::size_t i = 0; i < all.runs.size(); ++i)
    if (shard_of[i] == which.number)
      own.push_back(std::move(all.runs[i]));

  shard_outcome outcome;
  outcome.of_all = all.runs.size();
  if (which.number == 1) {
    outcome.failed = all.problems.size();
    for (const auto& problem : all.problems)
      console << problem << '\n';
  }
  const run_store store{options.out};
  making how = options;
  how.title = fmt::format("shard {} of {}  ", which.number, which.of);
  outcome.found = make_runs(own, store, how, interrupted, console);
  outcome.interrupted = interrupted;
  for (const auto& run : own)
    outcome.add({run.name, store.summary_of(run.name).value_or("")});
  return outcome;
}

std::size_t count_runs(std::span<const sweep_plan> plans,
                       std::string_view program,
                       const std::atomic<bool>& interrupted) {
  return runs_wanted_by_all(plans, program, interrupted).runs.size();
}

} // namespace sofof::experiments
