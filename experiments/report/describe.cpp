// From results folders to sections.
#include "experiments/report/describe.hpp"

#include "experiments/report/chain_section.hpp"
#include "experiments/report/comparison.hpp"
#include "experiments/report/crossing_section.hpp"
#include "experiments/report/energy_section.hpp"
#include "experiments/report/episode_table.hpp"
#include "experiments/report/key_figures.hpp"
#include "experiments/report/load_section.hpp"
#include "experiments/report/over_time.hpp"
#include "experiments/report/recorded_run.hpp"
#include "experiments/report/remote_results.hpp"
#include "experiments/report/vehicle_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <string>
#include <variant>

namespace sofof::experiments::report {

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

/// The runs in sentences.
section headline_of(runs_view runs) {
  section all{.title = "In short", .blocks = {}};
  for (const auto& run : runs) {
    std::string text;
    for (const auto& sentence : run.headline)
      text += (text.empty() ? "" : " ") + sentence;
    if (!text.empty())
      all.blocks.emplace_back(
          paragraph{runs.size() > 1 ? fmt::format("`{}`: {}", run.label, text)
                                    : std::move(text)});
  }
  return all;
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

/// Adds one run's table; among several it is called after its run.
void add_of_run(section& to, table one, const recorded_run& run,
                runs_view runs) {
  if (runs.size() > 1)
    one.title = run.label;
  to.blocks.emplace_back(std::move(one));
}

void add_episodes(std::vector<section>& to, runs_view runs) {
  section all{.title = "Episodes", .blocks = {}};
  for (const auto& run : runs)
    if (auto one = episode_table(run); !one.rows.empty())
      add_of_run(all, std::move(one), run, runs);
  if (all.blocks.empty())
    all.blocks.emplace_back(paragraph{"No offloading has ended."});
  to.push_back(std::move(all));
}

void add_vehicles(std::vector<section>& to, runs_view runs) {
  section all{.title = "Vehicles", .blocks = {}};
  for (const auto& run : runs)
    if (auto one = vehicle_table(run); !one.rows.empty())
      add_of_run(all, std::move(one), run, runs);
  if (!all.blocks.empty())
    to.push_back(std::move(all));
}

section configuration(runs_view runs) {
  section all{.title = "Configuration", .blocks = {}};
  for (const auto& run : runs)
    all.blocks.emplace_back(
        listing{runs.size() == 1 ? "config.toml" : run.label + "/config.toml",
                run.config_toml});
  return all;
}

/// One run, or two side by side.
std::vector<section> sections_of(runs_view runs) {
  std::vector<section> all;
  const auto add = [&all](section one) {
    if (!one.blocks.empty())
      all.push_back(std::move(one));
  };
  if (runs.size() > 1)
    all.push_back(what_differs(runs));
  add(headline_of(runs));
  all.push_back(drives(runs));
  add(chain_section(runs));
  all.push_back(figures(runs));
  add(load_section(runs));
  add(energy_section(runs));
  add_results(all, runs);
  add(crossing_section(runs));
  add(over_time(runs));
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
  text += fmt::format(", channel {}", run.what.profiles());
  if (!run.version.empty())
    text += fmt::format(", sofof {}", run.version);
  return text;
}

std::vector<section> one_after_the_other(runs_view runs) {
  std::vector<section> all{what_differs(runs), figures(runs)};
  add_results(all, runs);
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
  assert(!folders.empty());
  const auto runs = open_runs(folders);
  document all;
  for (const auto& run : runs) {
    all.title += (all.title.empty() ? "" : " · ") + run.label;
    all.subtitle += (all.subtitle.empty() ? "" : " · ") + what_was_run(run);
  }
  all.subtitle += fmt::format(" · report by sofof {}", version);
  all.sections =
      runs.size() > 2 ? one_after_the_other(runs) : sections_of(runs);
  if (runs.size() > 1)
    for (const auto& block : all.sections.front().blocks)
      if (const auto* options = std::get_if<table>(&block))
        all.subtitle = fmt::format("Differs in: {}. {}",
                                   difference_in_short(*options), all.subtitle);
  return all;
}

} // namespace sofof::experiments::report
