// Episodes with what their results were like.
#include "experiments/report/episode_table.hpp"

#include "experiments/report/documented.hpp"
#include "messages/protocol/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

namespace {

constexpr double ms_per_s = 1e3;

/// What the results of one episode were like.
struct episode_results {
  std::size_t count = 0;
  double latency_sum_ms = 0;
  double longest_latency_ms = 0;
  double longest_gap_ms = 0;
  double last_s = 0; ///< When the last one came.
};

std::map<session_key, episode_results>
results_by_episode(const recorded_run& run) {
  std::map<session_key, episode_results> all;
  if (!run.cycles)
    return all;
  for (const auto& line : *run.cycles) {
    auto& one = all[line.of];
    ++one.count;
    one.latency_sum_ms += line.latency_ms;
    one.longest_latency_ms = std::max(one.longest_latency_ms, line.latency_ms);
    one.longest_gap_ms =
        std::max(one.longest_gap_ms, line.interarrival_ms.value_or(0));
    one.last_s = std::max(one.last_s, line.received_s);
  }
  return all;
}

std::string seconds_text(std::optional<double> s) {
  return s ? fmt::format("{:.3f}", *s) : "";
}

std::string ms_text(const episode_results& of, double ms) {
  return of.count > 0 ? fmt::format("{:.2f}", ms) : "";
}

/// An episode, its results, and what the provider says of its end.
struct episode_entry {
  const episode_line& x;
  episode_results results;
  const episode_line* at_provider; ///< Null where that is not recorded.
};

/// @returns the reason of the side that ended it, as far as it is known.
std::string why(const episode_entry& e) {
  const auto provider_knows =
      e.x.because == messages::told_by_provider && e.at_provider
      && !e.at_provider->because.empty()
      && e.at_provider->because != messages::told_by_vehicle;
  return provider_knows ? e.at_provider->because : e.x.because;
}

std::map<session_key, const episode_line*>
those_of_providers(const recorded_run& run) {
  std::map<session_key, const episode_line*> all;
  for (const auto& one : run.episodes)
    if (!one.by_requester)
      all.emplace(one.of, &one);
  return all;
}

struct episode_column {
  std::string_view title;
  std::string_view name; ///< In episodes.csv; empty if reckoned from cycles.
  std::string (*text)(const episode_entry& of);
  std::string_view meaning{}; ///< Of what is reckoned.
};

constexpr episode_column episode_columns[]{
    {"vehicle", "station",
     [](const episode_entry& e) { return std::to_string(e.x.of.station); }},
    {"service", "service",
     [](const episode_entry& e) { return e.x.of.service; }},
    {"provider", "provider",
     [](const episode_entry& e) { return e.x.of.provider; }},
    {"accepted, s", "accepted_s",
     [](const episode_entry& e) { return seconds_text(e.x.accepted_s); }},
    {"first data, s", "first_data_s",
     [](const episode_entry& e) { return seconds_text(e.x.first_data_s); }},
    {"ended, s", "ended_s",
     [](const episode_entry& e) { return seconds_text(e.x.ended_s); }},
    {"offloaded, s", "t_off_s",
     [](const episode_entry& e) { return seconds_text(e.x.t_off_s); }},
    {"ended by", "reason", [](const episode_entry& e) { return e.x.reason; }},
    {"why", "because", why},
    {"fallback", "fallback",
     [](const episode_entry& e) {
       return std::string{e.x.fallback ? "yes" : ""};
     }},
    {"results", "",
     [](const episode_entry& e) {
       return e.results.count > 0 ? std::to_string(e.results.count) : "";
     },
     "results that came, used or not"},
    {"mean latency, ms", "",
     [](const episode_entry& e) {
       return ms_text(e.results, e.results.latency_sum_ms
                                     / static_cast<double>(e.results.count));
     },
     "of all results that came: received after the start of their cycle"},
    {"longest latency, ms", "",
     [](const episode_entry& e) {
       return ms_text(e.results, e.results.longest_latency_ms);
     },
     "of all results that came"},
    {"longest gap, ms", "",
     [](const episode_entry& e) {
       return ms_text(e.results, e.results.longest_gap_ms);
     },
     "between two results, while the service was remote"},
};

} // namespace

table episode_table(const recorded_run& run) {
  table all;
  for (const auto& column : episode_columns) {
    all.columns.emplace_back(column.title);
    all.column_meanings.push_back(
        column.name.empty() ? std::string{column.meaning}
                            : documented("episodes.csv", column.name));
  }
  if (!run.episodes.empty())
    for (const auto& [name, text] : run.episodes.front().others) {
      all.columns.push_back(name);
      all.column_meanings.push_back(documented("episodes.csv", name));
    }
  const auto by_vehicles =
      std::ranges::any_of(run.episodes, &episode_line::by_requester);
  const auto results = results_by_episode(run);
  const auto at_providers = those_of_providers(run);
  for (const auto& one : run.episodes) {
    if (one.by_requester != by_vehicles)
      continue;
    const auto found = results.find(one.of);
    const auto other = at_providers.find(one.of);
    episode_entry entry{
        one, found == results.end() ? episode_results{} : found->second,
        other == at_providers.end() ? nullptr : other->second};
    if (entry.results.count > 0 && one.reason == "qos_gap")
      entry.results.longest_gap_ms =
          std::max(entry.results.longest_gap_ms,
                   ms_per_s * (one.ended_s - entry.results.last_s));
    auto& row = all.rows.emplace_back();
    for (const auto& column : episode_columns)
      row.push_back(column.text(entry));
    for (const auto& [name, text] : one.others)
      row.push_back(text);
  }
  if (!by_vehicles && !all.rows.empty())
    all.note = "As the provider closed them.";
  return all;
}

} // namespace sofof::experiments::report
