// From results folders to sections.
#include "scenario/report/describe.hpp"

#include "scenario/report/csv_reader.hpp"
#include "scenario/report/key_figures.hpp"
#include "scenario/report/options.hpp"
#include "scenario/report/recorded_run.hpp"
#include "scenario/report/remote_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <string>

namespace sofof::report {

namespace {

namespace fs = std::filesystem;
using runs_view = std::span<const recorded_run>;

/// What a reader has to know before the figures.
void add_remarks(section& to, const recorded_run& run, bool several) {
  const auto say = [&](std::string_view what) {
    to.blocks.emplace_back(
        paragraph{several ? fmt::format("`{}`: {}", run.label, what)
                          : std::string{what}});
  };
  if (!run.figures)
    say("This run was killed: there is no `summary.json`, and the last few "
        "seconds may be missing. What it had written until then is shown.");
  if (run.interrupted)
    say("This run was interrupted before its planned length; all figures count "
        "up to there.");
}

section drives(runs_view runs) {
  section all{.title = runs.size() == 1 ? "Drive" : "Drives", .blocks = {}};
  for (const auto& run : runs)
    add_remarks(all, run, runs.size() > 1);
  for (const auto& run : runs)
    all.blocks.emplace_back(drive{run.folder});
  return all;
}

section figures(runs_view runs) {
  section all{.title = "Key figures", .blocks = {}};
  for (auto& one : key_figures(runs))
    all.blocks.emplace_back(std::move(one));
  return all;
}

void add_results(std::vector<section>& to, runs_view runs) {
  for (const auto& service : services_of(runs)) {
    section all{.title = "Remote results of " + service, .blocks = {}};
    for (auto& one : remote_results(runs, service))
      all.blocks.emplace_back(std::move(one));
    if (!all.blocks.empty())
      to.push_back(std::move(all));
  }
}

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
  for (const auto& line : run.cycles.value_or(std::vector<cycle_line>{})) {
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

/// Episodes as the vehicles closed them; where no vehicle runs, as the
/// provider did.
table episodes_of(const recorded_run& run, bool several) {
  table all{.title = several ? run.label : "",
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
    all.note = "As the provider closed them; no vehicle ran here.";
  return all;
}

void add_episodes(std::vector<section>& to, runs_view runs) {
  section all{.title = "Episodes", .blocks = {}};
  for (const auto& run : runs)
    if (auto one = episodes_of(run, runs.size() > 1); !one.rows.empty())
      all.blocks.emplace_back(std::move(one));
  if (all.blocks.empty())
    all.blocks.emplace_back(paragraph{"No offloading has ended."});
  to.push_back(std::move(all));
}

/// How each vehicle drove; written at the end of a run only.
std::optional<table> vehicles_of(const recorded_run& run, bool several) {
  struct column {
    std::string_view name;
    std::string_view shown;
    int decimals;
  };
  static constexpr std::array columns{
      column{"station", "vehicle", 0},
      column{"distance_m", "way, m", 0},
      column{"plans", "plans", 0},
      column{"emergency_plans", "emergency plans", 0},
      column{"safe_stops", "safe stops", 0},
      column{"collisions", "collisions", 0},
      column{"max_plan_age_ms", "oldest plan, ms", 1},
      column{"min_accel_mps2", "lowest acceleration, m/s²", 2},
      column{"max_jerk_mps3", "largest jerk, m/s³", 2},
      column{"max_lateral_accel_mps2", "largest lateral acceleration, m/s²", 2},
      column{"hard_brakes", "hard brakes", 0},
      column{"comfort_cost_m2ps3", "comfort cost, m²/s³", 1},
  };
  const auto file = run.folder / "vehicles.csv";
  if (!fs::exists(file))
    return std::nullopt;
  table all{
      .title = several ? run.label : "", .columns = {}, .rows = {}, .note = ""};
  std::vector<std::string_view> wanted;
  for (const auto& [name, shown, decimals] : columns) {
    all.columns.emplace_back(shown);
    wanted.push_back(name);
  }
  csv_reader line{file, wanted};
  while (line.next()) {
    auto& row = all.rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto x = line.number_if_any(i);
      row.push_back(x ? fmt::format("{:.{}f}", *x, columns[i].decimals) : "");
    }
  }
  return all;
}

void add_vehicles(std::vector<section>& to, runs_view runs) {
  section all{.title = "Vehicles", .blocks = {}};
  for (const auto& run : runs)
    if (auto one = vehicles_of(run, runs.size() > 1); one && !one->rows.empty())
      all.blocks.emplace_back(std::move(*one));
  if (!all.blocks.empty())
    to.push_back(std::move(all));
}

section configuration(runs_view runs) {
  section all{.title = "Configuration", .blocks = {}};
  if (runs.size() == 2) {
    auto differing =
        differing_options(runs[0].config_toml, runs[1].config_toml);
    differing.title = "Options that differ";
    differing.columns = {"option", runs[0].label, runs[1].label};
    if (differing.rows.empty())
      all.blocks.emplace_back(
          paragraph{"Both runs have the same configuration."});
    else
      all.blocks.emplace_back(std::move(differing));
  }
  for (const auto& run : runs)
    all.blocks.emplace_back(
        listing{runs.size() == 1 ? "config.toml" : run.label + "/config.toml",
                run.config_toml});
  return all;
}

/// One run, or two side by side.
std::vector<section> sections_of(runs_view runs) {
  std::vector<section> all{drives(runs), figures(runs)};
  add_results(all, runs);
  add_episodes(all, runs);
  add_vehicles(all, runs);
  all.push_back(configuration(runs));
  return all;
}

std::string what_was_run(const recorded_run& run) {
  auto text = fmt::format("{}, seed {}", run.what.name, run.what.seed);
  if (const auto count = run.figure("vehicles"))
    text += fmt::format(", {} vehicles", *count);
  if (const auto length_s = run.figure("virtual_s"))
    text += fmt::format(", {:.0f} s", *length_s);
  if (!run.clock.empty())
    text += fmt::format(", {} clock", run.clock);
  text += fmt::format(", channel {}", run.what.network.profile);
  if (!run.version.empty())
    text += fmt::format(", sofof {}", run.version);
  return text;
}

std::vector<section> one_after_the_other(runs_view runs) {
  std::vector<section> all{figures(runs)};
  for (const auto& run : runs)
    for (auto& one : sections_of({&run, 1})) {
      one.title = fmt::format("{}: {}", run.label, one.title);
      all.push_back(std::move(one));
    }
  return all;
}

} // namespace

std::vector<section> describe_run(const fs::path& folder) {
  const auto runs = open_runs({&folder, 1});
  return sections_of(runs);
}

std::vector<section> compare_runs(const fs::path& first,
                                  const fs::path& second) {
  const auto runs = open_runs(std::array{first, second});
  return sections_of(runs);
}

document describe(std::span<const fs::path> folders, std::string_view version) {
  const auto runs = open_runs(folders);
  document all;
  for (const auto& run : runs) {
    all.title += (all.title.empty() ? "" : " · ") + run.label;
    all.subtitle += (all.subtitle.empty() ? "" : " · ") + what_was_run(run);
  }
  all.subtitle += fmt::format(" · report by sofof {}", version);
  all.sections =
      runs.size() > 2 ? one_after_the_other(runs) : sections_of(runs);
  return all;
}

} // namespace sofof::report
