// Episodes with what their results were like.
#include "experiments/report/episode_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sofof::report {

namespace {

/// What the results of one episode were like.
struct episode_results {
  std::size_t count = 0;
  double latency_sum_ms = 0;
  double longest_latency_ms = 0;
  double longest_gap_ms = 0;
};

std::map<offloading_name, episode_results>
results_by_episode(const recorded_run& run) {
  std::map<offloading_name, episode_results> all;
  if (!run.cycles)
    return all;
  for (const auto& line : *run.cycles) {
    auto& one = all[line.of];
    ++one.count;
    one.latency_sum_ms += line.latency_ms;
    one.longest_latency_ms = std::max(one.longest_latency_ms, line.latency_ms);
    one.longest_gap_ms =
        std::max(one.longest_gap_ms, line.interarrival_ms.value_or(0));
  }
  return all;
}

std::string seconds_text(std::optional<double> s) {
  return s ? fmt::format("{:.3f}", *s) : "";
}

std::vector<std::string> episode_row(const episode_line& x,
                                     const episode_results& results) {
  const auto if_any = [&results](double ms) {
    return results.count > 0 ? fmt::format("{:.2f}", ms) : "";
  };
  return {std::to_string(x.of.station),
          x.of.service,
          x.of.provider,
          fmt::format("{:.3f}", x.accepted_s),
          seconds_text(x.first_data_s),
          fmt::format("{:.3f}", x.ended_s),
          seconds_text(x.t_off_s),
          x.reason,
          x.fallback ? "yes" : "",
          results.count > 0 ? std::to_string(results.count) : "",
          if_any(results.latency_sum_ms / static_cast<double>(results.count)),
          if_any(results.longest_latency_ms),
          if_any(results.longest_gap_ms)};
}

} // namespace

table episode_table(const recorded_run& run) {
  table all{.title = "",
            .columns = {"vehicle", "service", "provider", "accepted, s",
                        "first data, s", "ended, s", "offloaded, s", "ended by",
                        "fallback", "results", "mean latency, ms",
                        "longest latency, ms", "longest gap, ms"},
            .rows = {},
            .note = ""};
  const auto by_vehicles =
      std::ranges::any_of(run.episodes, &episode_line::by_requester);
  const auto results = results_by_episode(run);
  for (const auto& one : run.episodes) {
    if (one.by_requester != by_vehicles)
      continue;
    const auto found = results.find(one.of);
    all.rows.push_back(episode_row(
        one, found == results.end() ? episode_results{} : found->second));
  }
  if (!by_vehicles && !all.rows.empty())
    all.note = "As the provider closed them.";
  return all;
}

} // namespace sofof::report
