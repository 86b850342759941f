// Episodes run by run, with the runs that were not seen.
#include "experiments/dehler2025/offloading_time.hpp"

#include <algorithm>
#include <cassert>
#include <set>

namespace sofof::experiments::study {

namespace {

constexpr double enough_seen = 3;

/// All runs together, and how many have an early end.
struct overview {
  run_episodes all;
  double with = 0;
  double runs = 0;

  bool is_rare() const { return all.count > 0 && all.early <= all.passes(); }
  bool lacks_early_ends() const { return is_rare() && with < enough_seen; }
  bool lacks_full_passes() const {
    return is_rare() && runs - with < enough_seen;
  }
};

overview overview_of(std::span<const run_episodes> runs) {
  overview o;
  for (const auto& run : runs) {
    o.all.t_off_s += run.t_off_s;
    o.all.count += run.count;
    o.all.early += run.early;
    o.all.hours += run.hours;
    o.with += run.early > 0 ? 1 : 0;
    ++o.runs;
  }
  return o;
}

std::optional<interval> t_off_with(std::span<const run_episodes> runs,
                                   const overview& o, bool all_early,
                                   bool none_early) {
  std::vector<group> groups;
  for (const auto& run : runs)
    groups.push_back({run.t_off_s, run.count});
  unseen_groups unseen;
  const auto passes = o.all.passes() / o.runs;
  if (all_early)
    unseen.lowest = {o.all.t_off_s / o.runs, 2 * passes};
  if (none_early)
    unseen.highest = {o.all.t_off_s / o.runs, passes};
  return mean_interval(groups, unseen);
}

} // namespace

std::optional<interval> mean_t_off(std::span<const run_episodes> runs) {
  const auto o = overview_of(runs);
  return t_off_with(runs, o, o.lacks_early_ends(), o.lacks_full_passes());
}

std::optional<interval> cautious_t_off(std::span<const run_episodes> runs) {
  const auto o = overview_of(runs);
  return t_off_with(runs, o, o.is_rare(), o.is_rare());
}

std::optional<interval>
early_ends_per_hour(std::span<const run_episodes> runs) {
  const auto o = overview_of(runs);
  std::vector<group> groups;
  for (const auto& run : runs)
    groups.push_back({run.early, run.hours});
  unseen_groups unseen;
  if (o.all.hours > 0) {
    const auto hours = o.all.hours / o.runs;
    if (o.lacks_early_ends())
      unseen.highest = {o.all.passes() / o.runs, hours};
    if (o.lacks_full_passes())
      unseen.lowest = {0, hours};
  }
  return mean_interval(groups, unseen);
}

std::vector<run_episodes>
episodes_of(std::span<const measured_run* const> runs) {
  constexpr double hour_s = 3600;
  std::vector<run_episodes> all;
  for (const auto* run : runs) {
    auto& e = all.emplace_back();
    for (const auto t : run->t_off_s)
      e.t_off_s += t;
    e.count = static_cast<double>(run->t_off_s.size());
    e.early = static_cast<double>(run->ended_early);
    const auto share = run->figures.find("offloaded_share");
    if (share != run->figures.end())
      e.hours = share->second * run->figure("safety.driven_s") / hour_s;
  }
  return all;
}

std::optional<interval> mean_t_off(std::span<const measured_run* const> runs) {
  return mean_t_off(episodes_of(runs));
}

std::optional<interval>
early_ends_per_hour(std::span<const measured_run* const> runs) {
  return early_ends_per_hour(episodes_of(runs));
}

std::vector<std::int64_t>
seeds_with_early_ends(std::span<const measured_run* const> runs) {
  std::set<std::int64_t> seeds;
  for (const auto* run : runs)
    if (run->ended_early > 0)
      seeds.insert(run->point.seed);
  return {seeds.begin(), seeds.end()};
}

bool needs_more_runs(std::span<const run_episodes> runs,
                     const seed_rule& rule) {
  const auto t_off = cautious_t_off(runs);
  return !t_off || t_off->half_width() > rule.narrow_s;
}

std::size_t runs_wanted(std::size_t have, std::size_t most,
                        std::span<const run_episodes> runs,
                        const seed_rule& rule) {
  assert(have >= 1);
  if (have >= most || !needs_more_runs(runs, rule))
    return have;
  return std::min(2 * have, most);
}

} // namespace sofof::experiments::study
