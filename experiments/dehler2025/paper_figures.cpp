// From runs to the figures that claims are held against.
#include "experiments/dehler2025/paper_figures.hpp"

#include "base/options/units.hpp"
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::experiments::study {

namespace {

/// @returns the mean latency of these runs, each run a group.
std::optional<interval>
mean_latency_ms(std::span<const measured_run* const> runs) {
  std::vector<group> groups;
  for (const auto* run : runs) {
    const auto mean = run->figures.find("latency_ms.mean");
    if (mean == run->figures.end())
      continue;
    const auto count = run->figure("latency_ms.count");
    groups.push_back({mean->second * count, count});
  }
  return mean_interval(groups);
}

vehicle_figures figures_of(const paper_runs& e, const std::string& vehicles) {
  vehicle_figures f;
  f.vehicles = std::stoi(vehicles);
  for (const auto& gap : labels_of(e.latency_plot, 1))
    f.curve.push_back(
        {ms_of(gap), mean_t_off(those(e.latency_plot, vehicles, gap))});
  f.time_in_area_s = mean_time_in_area_s(those(e.in_area, 0, vehicles));
  const auto runs = those(e.latency_plot, 0, vehicles);
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

paper_figures figures_of(const paper_runs& e) {
  paper_figures all;
  for (const auto& n : labels_of(e.latency_plot, 0))
    all.by_vehicles.push_back(figures_of(e, n));
  std::vector<const measured_run*> drives;
  for (const auto& run : e.real_world) {
    drives.push_back(&run);
    all.drives_ended_early += run.ended_early > 0 ? 1U : 0U;
  }
  all.drives = drives.size();
  all.real_latency_ms = pooled(drives, "latency_ms");
  all.cpu_20_hz = e.cpu_20_hz.figures.shares;
  all.cpu_100_hz = e.cpu_100_hz.figures.shares;
  if (e.cpu_20_hz.length_s > 0)
    all.v2x_at_most = e.cpu_20_hz.v2x_at_most;
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
