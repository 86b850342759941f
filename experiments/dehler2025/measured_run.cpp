// Reads runs, and pools them.
#include "experiments/dehler2025/measured_run.hpp"

#include "base/input_error.hpp"
#include "experiments/report/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sofof::experiments::study {

double measured_run::figure(const std::string& name) const {
  const auto found = figures.find(name);
  if (found == figures.end())
    throw input_error{fmt::format("{}: its summary has no figure {}.",
                                  folder.string(), name)};
  return found->second;
}

measured_run read_run(const sweep_point& point,
                      const std::filesystem::path& folder) {
  const auto summary = report::read_summary(folder);
  if (!summary)
    throw input_error{
        fmt::format("{}: this run has not come to its end.", folder.string())};
  measured_run run{point, folder, summary->figures, {}, 0};
  for (const auto& episode : report::read_episodes(folder)) {
    if (!episode.by_requester)
      run.served_s[{place_of(episode.of.provider_id), episode.of.service}] +=
          episode.ended_s - episode.accepted_s;
    if (!episode.by_requester || episode.of.service != planning
        || !episode.t_off_s || episode.is_cut_off())
      continue;
    run.t_off_s.push_back(*episode.t_off_s);
    run.ended_early += episode.fallback ? 1U : 0U;
    run.ended_late += episode.reason == "qos_latency" ? 1U : 0U;
  }
  return run;
}

std::vector<std::string> labels_of(std::span<const measured_run> runs,
                                   std::size_t axis) {
  std::vector<std::string> labels;
  for (const auto& run : runs)
    if (std::ranges::find(labels, run.point.labels[axis]) == labels.end())
      labels.push_back(run.point.labels[axis]);
  return labels;
}

std::vector<const measured_run*> those(std::span<const measured_run> runs,
                                       std::size_t axis,
                                       const std::string& label) {
  std::vector<const measured_run*> found;
  for (const auto& run : runs)
    if (run.point.labels.at(axis) == label)
      found.push_back(&run);
  return found;
}

std::vector<const measured_run*> those(std::span<const measured_run> runs,
                                       const std::string& first,
                                       const std::string& second) {
  auto found = those(runs, 0, first);
  std::erase_if(found, [&second](const auto* run) {
    return run->point.labels.at(1) != second;
  });
  return found;
}

spread pooled(std::span<const measured_run* const> runs,
              const std::string& name) {
  double count = 0, sum = 0, squares = 0;
  for (const auto* run : runs) {
    const auto n = run->figure(name + ".count");
    if (n < 2)
      continue;
    const auto mean = run->figure(name + ".mean");
    const auto deviation = run->figure(name + ".std");
    count += n;
    sum += n * mean;
    squares += (n - 1) * deviation * deviation + n * mean * mean;
  }
  if (count < 2)
    return {};
  const auto mean = sum / count;
  return {mean, std::sqrt((squares - count * mean * mean) / (count - 1)),
          count};
}

} // namespace sofof::experiments::study
