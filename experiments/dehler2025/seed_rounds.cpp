// Combinations of values, each with its runs.
#include "experiments/dehler2025/seed_rounds.hpp"

#include "experiments/sweep/run_store.hpp"
#include "experiments/sweep/wanted_runs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

namespace sofof::experiments::study {

bool add_seeds(sweep_plan& plan, std::span<const measured_run> runs,
               const seed_rule& rule) {
  if (plan.most_seeds.empty())
    return false;
  std::map<std::vector<std::string>, std::vector<const measured_run*>>
      by_values;
  for (const auto& run : runs)
    by_values[run.point.labels].push_back(&run);
  auto one_each = plan;
  one_each.seeds_of.assign(plan.combinations(), 1);
  if (plan.seeds_of.empty())
    plan.seeds_of.assign(plan.combinations(), plan.seeds.size());
  auto added = false;
  const auto combinations = points_of(one_each);
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    auto& count = plan.seeds_of[i];
    const auto wanted =
        runs_wanted(count, plan.most_seeds_of(i) * rule.times,
                    episodes_of(by_values[combinations[i].labels]), rule);
    added = added || wanted > count;
    count = wanted;
  }
  return added;
}

sweep_plan next_round(sweep_plan plan, const sweep_options& options,
                      const seed_rule& rule,
                      const std::atomic<bool>& interrupted) {
  if (plan.most_seeds.empty() || !std::filesystem::exists(options.out / "runs"))
    return plan;
  const run_store store{options.out};
  while (!interrupted) {
    const auto wanted = runs_wanted_by(plan, options.program, interrupted);
    const auto points = points_of(plan);
    std::vector<measured_run> runs;
    for (std::size_t i = 0; i < wanted.run_of.size(); ++i) {
      const auto& name = wanted.run_of[i];
      if (!name.empty() && !store.summary_of(name))
        return plan;
      if (!name.empty())
        runs.push_back(read_run(points[i], store.folder_of(name)));
    }
    if (!add_seeds(plan, runs, rule))
      return plan;
  }
  return plan;
}

} // namespace sofof::experiments::study
