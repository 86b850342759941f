// Opens results folders.
#include "experiments/report/recorded_run.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace sofof::experiments::report {

namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& folder) {
  auto whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename())
    whole = whole.parent_path();
  return whole.filename().string();
}

} // namespace

std::optional<double> recorded_run::figure(const std::string& name) const {
  if (!figures)
    return std::nullopt;
  const auto found = figures->find(name);
  return found == figures->end() ? std::nullopt : std::optional{found->second};
}

std::optional<std::size_t>
recorded_run::place_of(const std::string& provider) const {
  const auto& all = what.providers;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == provider)
      return i;
  return std::nullopt;
}

std::string config_of(const fs::path& folder) {
  const auto config = folder / "config.toml";
  if (!fs::exists(config))
    throw input_error{fmt::format("{} is no results folder: there is no {}; "
                                  "name a folder that a run has written.",
                                  folder.string(), config.string())};
  return require_text(config);
}

recorded_run open_run(const fs::path& folder) {
  recorded_run run;
  run.folder = folder;
  run.label = name_of(folder);
  // What a run has written is not to be changed: notes on it are not told.
  run.config_toml = config_of(folder);
  run.what = scenario::parse_scenario(run.config_toml, folder / "config.toml");
  run.episodes = read_episodes(folder);
  run.cycles = read_cycles(folder);
  if (auto summary = read_summary(folder)) {
    run.figures = std::move(summary->figures);
    run.version = std::move(summary->version);
    run.clock = std::move(summary->clock);
    run.interrupted = summary->interrupted;
    run.headline = std::move(summary->headline);
  }
  return run;
}

std::vector<recorded_run> open_runs(std::span<const fs::path> folders) {
  for (auto one = folders.begin(); one != folders.end(); ++one)
    if (const auto again = std::find_if(folders.begin(), one,
                                        [one](const fs::path& other) {
                                          std::error_code ignored;
                                          return fs::equivalent(other, *one,
                                                                ignored);
                                        });
        again != one)
      throw input_error{fmt::format(
          "{} and {} are one folder; name another run to compare it with.",
          again->string(), one->string())};
  std::vector<recorded_run> runs;
  for (const auto& folder : folders)
    runs.push_back(open_run(folder));
  for (auto& run : runs)
    if (std::ranges::count(folders, name_of(run.folder), name_of) > 1)
      run.label = run.folder.string();
  return runs;
}

std::vector<std::string> services_of(std::span<const recorded_run> runs) {
  std::vector<std::string> names;
  for (const auto& run : runs)
    for (const auto& service : run.what.services)
      if (std::ranges::find(names, service->name()) == names.end())
        names.emplace_back(service->name());
  return names;
}

} // namespace sofof::experiments::report
