// One run as a measure of all.
#include "experiments/dehler2025/effort.hpp"

#include "base/text/csv_reader.hpp"
#include "experiments/sweep/make_runs.hpp"
#include "experiments/sweep/run_store.hpp"
#include "experiments/sweep/wanted_runs.hpp"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>

namespace sofof::experiments::study {

namespace {

/// @returns what a run took on the wall's clock, s; 0 if it did not say.
double wall_s_of(const std::filesystem::path& folder) {
  constexpr std::string_view columns[] = {"figure", "value"};
  csv_reader rows{folder / "timing.csv", columns};
  while (rows.next())
    if (rows.text(0) == "wall_s")
      return rows.number(1);
  return 0;
}

} // namespace

effort longest_effort(std::span<const sweep_plan> plans,
                      const sweep_options& options, const seed_rule& rule,
                      const std::atomic<bool>& interrupted,
                      std::ostream& console) {
  assert(!plans.empty());
  effort all;
  all.jobs = options.jobs;
  double cost = 0;
  wanted_run probe;
  for (const auto& plan : plans) {
    auto one_each = plan;
    one_each.seeds = {plan.seeds.front()};
    one_each.most_seeds = 1;
    const auto grows = plan.most_seeds > plan.seeds.size();
    const auto seeds = grows ? plan.most_seeds * rule.times : plan.seeds.size();
    for (const auto& run :
         runs_wanted_by(one_each, options.program, interrupted).runs) {
      cost += run.cost * static_cast<double>(seeds);
      all.runs += seeds;
      if (probe.name.empty())
        probe = run;
    }
  }
  if (interrupted)
    return all;
  const run_store store{options.out};
  making how = options;
  how.show = recording::progress::output::quiet;
  make_runs({probe}, store, how, interrupted, console);
  if (interrupted)
    return all;
  constexpr double hour_s = 3600;
  all.probe_s = wall_s_of(store.folder_of(probe.name));
  all.hours = all.probe_s * cost / probe.cost / all.jobs / hour_s;
  return all;
}

std::string text_of(const effort& e) {
  return fmt::format("at most {} runs, {:.1f} hours with {} at a time, as one "
                     "of them took {:.1f} s; fewer where intervals are narrow "
                     "before",
                     e.runs, e.hours, e.jobs, e.probe_s);
}

} // namespace sofof::experiments::study
