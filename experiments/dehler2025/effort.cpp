// One run as a measure of all.
#include "experiments/dehler2025/effort.hpp"

#include "base/text/csv_reader.hpp"
#include "experiments/sweep/make_runs.hpp"
#include "experiments/sweep/run_store.hpp"
#include "experiments/sweep/wanted_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

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
  std::vector<wanted_run> probes; // as many as there will be at a time
  for (const auto& plan : plans) {
    auto some = plan;
    some.seeds.resize(std::min<std::size_t>(options.jobs, plan.seeds.size()));
    some.most_seeds.clear();
    const auto times = plan.most_seeds.empty() ? 1 : rule.times;
    for (std::size_t i = 0; i < plan.combinations(); ++i)
      all.runs += plan.most_seeds_of(i) * times;
    const auto wanted = runs_wanted_by(some, options.program, interrupted);
    std::map<std::string_view, double> cost_of;
    for (const auto& run : wanted.runs)
      cost_of[run.name] = run.cost;
    const auto probed = some.seeds.size();
    for (std::size_t i = 0; i < wanted.run_of.size(); ++i)
      cost += cost_of[wanted.run_of[i]]
              * static_cast<double>(plan.most_seeds_of(i / probed) * times)
              / static_cast<double>(probed);
    for (const auto& run : wanted.runs) {
      if (!probes.empty() && run.cost > probes.front().cost)
        probes.clear();
      if (probes.empty()
          || (run.cost == probes.front().cost && probes.size() < options.jobs))
        probes.push_back(run);
    }
  }
  if (interrupted)
    return all;
  const run_store store{options.out};
  making how = options;
  how.show = recording::progress::output::quiet;
  make_runs(probes, store, how, interrupted, console);
  if (interrupted)
    return all;
  for (const auto& probe : probes)
    all.probe_s = std::max(all.probe_s, wall_s_of(store.folder_of(probe.name)));
  constexpr double hour_s = 3600;
  all.hours = all.probe_s * cost / probes.front().cost / all.jobs / hour_s;
  return all;
}

std::string text_of(const effort& e) {
  return fmt::format("at most {} runs, {:.1f} hours with {} at a time, as one "
                     "of them took {:.1f} s; fewer where intervals are narrow "
                     "before",
                     e.runs, e.hours, e.jobs, e.probe_s);
}

} // namespace sofof::experiments::study
