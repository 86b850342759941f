// From runs to the figures that claims are held against.
#include "experiments/dehler2025/paper_figures.hpp"

#include "base/options/units.hpp"
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/normal_interval.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>

namespace sofof::experiments::study {

namespace {

/// @returns the mean latency of these runs, the runs of each seed a group,
/// since they have the same noise.
std::optional<interval>
mean_latency_ms(std::span<const measured_run* const> runs) {
  std::map<std::int64_t, group> by_seed;
  for (const auto* run : runs) {
    const auto mean = run->figures.find("latency_ms.mean");
    if (mean == run->figures.end())
      continue;
    const auto count = run->figure("latency_ms.count");
    auto& own = by_seed[run->point.seed];
    own.sum += mean->second * count;
    own.count += count;
  }
  std::vector<group> groups;
  for (const auto& [seed, own] : by_seed)
    groups.push_back(own);
  return mean_interval(groups);
}

std::map<std::int64_t, spread>
latencies_by_seed(std::span<const measured_run* const> runs) {
  std::map<std::int64_t, std::vector<const measured_run*>> by_seed;
  for (const auto* run : runs)
    by_seed[run->point.seed].push_back(run);
  std::map<std::int64_t, spread> all;
  for (const auto& [seed, own] : by_seed)
    all.emplace(seed, pooled(own, "latency_ms"));
  return all;
}

/// @returns the mean change from some runs to others, seed by seed.
std::optional<interval> step_between(const std::map<std::int64_t, spread>& from,
                                     const std::map<std::int64_t, spread>& to,
                                     double spread::*of) {
  std::vector<group> steps;
  for (const auto& [seed, after] : to)
    if (const auto before = from.find(seed);
        before != from.end() && before->second.count > 0 && after.count > 0)
      steps.push_back({after.*of - before->second.*of, 1});
  return mean_interval(steps);
}

/// Each run on the wall's clock a group.
/// @returns the mean of shares of time, none of which is below 0.
std::optional<interval> share_of_time(std::span<const group> groups) {
  auto x = normal_mean_interval(groups);
  if (x)
    x->low = std::max(x->low, 0.0);
  return x;
}

std::optional<cost_figures> costs_of(const measured_cpu& measured) {
  constexpr double percent = 100;
  std::vector<group> active, inactive, remote, balance;
  bool all_save = true;
  for (const auto& own : measured.runs) {
    const auto& c = own.shares;
    active.push_back({c.active * own.active_s, own.active_s});
    inactive.push_back({c.inactive * own.inactive_s, own.inactive_s});
    remote.push_back({c.requester_remote * own.inactive_s, own.inactive_s});
    all_save = all_save && recording::break_even_share(c);
    balance.push_back(
        {percent * c.requester, recording::saved_while_offloaded(c)});
  }
  const auto a = share_of_time(active), d = share_of_time(inactive),
             r = share_of_time(remote);
  if (!a || !d || !r)
    return std::nullopt;
  cost_figures all{*a, *d, *r, std::nullopt};
  // The figure is that of all runs together, as the study's table has it; a
  // mean over runs weighs them otherwise.
  const auto together = recording::break_even_share(measured.figures.shares);
  if (const auto apart = share_of_time(balance); apart && together) {
    const auto from = percent * *together;
    all.break_even = {from, std::min(apart->low, from),
                      all_save ? std::max(apart->high, from)
                               : std::numeric_limits<double>::infinity()};
  }
  return all;
}

vehicle_figures figures_of(const paper_runs& e, const std::string& vehicles) {
  vehicle_figures f;
  f.vehicles = std::stoi(vehicles);
  for (const auto& gap : labels_of(e.latency_plot, 1))
    f.curve.push_back(
        {ms_of(gap), mean_t_off(those(e.latency_plot, vehicles, gap))});
  f.time_in_area_s = mean_time_in_area_s(those(e.in_area, 0, vehicles));
  const auto runs = latency_runs(e, vehicles);
  f.latency_ms = mean_latency_ms(runs);
  f.latency_deviation_ms = pooled(runs, "latency_ms").deviation;
  histogram latencies;
  for (const auto* run : runs)
    latencies.add(read_histogram(run->folder, planning, "latency"));
  f.late_share = latencies.share_above(paper::max_latency_ms);
  return f;
}

} // namespace

double ms_of(const std::string& duration_text) {
  return to_milliseconds(parse_duration(duration_text).value());
}

std::vector<const measured_run*> latency_runs(const paper_runs& e,
                                              const std::string& vehicles) {
  std::map<std::int64_t, std::size_t> points_of;
  std::set<std::vector<std::string>> points;
  for (const auto& run : e.latency_plot) {
    ++points_of[run.point.seed];
    points.insert(run.point.labels);
  }
  std::vector<const measured_run*> chosen;
  for (const auto* run : those(e.latency_plot, 0, vehicles))
    if (points_of[run->point.seed] == points.size())
      chosen.push_back(run);
  return chosen;
}

paper_figures figures_of(const paper_runs& e) {
  paper_figures all;
  std::map<std::int64_t, spread> before;
  for (const auto& n : labels_of(e.latency_plot, 0)) {
    auto& own = all.by_vehicles.emplace_back(figures_of(e, n));
    auto latencies = latencies_by_seed(latency_runs(e, n));
    own.mean_step_ms = step_between(before, latencies, &spread::mean);
    own.deviation_step_ms = step_between(before, latencies, &spread::deviation);
    before = std::move(latencies);
  }
  std::vector<const measured_run*> drives;
  for (const auto& run : e.real_world) {
    drives.push_back(&run);
    all.drives_ended_early += run.ended_early > 0 ? 1U : 0U;
  }
  all.drives = drives.size();
  all.real_latency_ms = pooled(drives, "latency_ms");
  all.cpu_20_hz = costs_of(e.cpu_20_hz);
  all.cpu_100_hz = costs_of(e.cpu_100_hz);
  for (const auto* run : {&e.cpu_20_hz, &e.cpu_100_hz})
    if (run->length_s > 0)
      all.v2x_at_most = std::max(all.v2x_at_most.value_or(0), run->v2x_at_most);
  for (const auto* run : those(e.quality, 0, "location")) {
    const auto count = run->figure("switch.count");
    if (!(count > 0))
      continue;
    all.switches += count;
    all.largest_speed_jump_mps =
        std::max(all.largest_speed_jump_mps, run->figure("switch.max_v_mps"));
    all.largest_acceleration_jump_mps2 = std::max(
        all.largest_acceleration_jump_mps2, run->figure("switch.max_a_mps2"));
  }
  return all;
}

} // namespace sofof::experiments::study
