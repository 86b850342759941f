// From a scenario file to a scenario that is ready to run.
#include "scenario/load.hpp"

#include "base/files/regular_file.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/checks.hpp"
#include "scenario/map_file.hpp"
#include "scenario/placement.hpp"
#include "scenario/policy_files.hpp"
#include "scenario/quality_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace sofof::scenario {

namespace fs = std::filesystem;

namespace {

/// Reads a file that an option of the scenario names.
std::string read_named(const fs::path& file, std::string_view key,
                       const toml_file& source) {
  auto content = read_regular_file(file, longest_input);
  if (!content.refusal.empty())
    source.refuse(key, fmt::format("the file {} cannot be read: {}.",
                                   file.string(), content.refusal));
  return std::move(content.text);
}

/// Streets never change, so a thread that loads one map again and again, for a
/// sweep, parses it once.
world::streets_ptr known_map(const std::string& text, const fs::path& file) {
  struct parsed_map {
    std::string text;
    fs::path file;
    world::streets_ptr streets;
  };
  thread_local parsed_map last;
  if (!last.streets || last.text != text || last.file != file)
    last = {text, file, parse_map(text, file)};
  return last.streets;
}

/// @param map_text  Of a map that is no file.
void load_world(scenario_definition& all, const fs::path& folder,
                const toml_file& source, std::optional<std::string> map_text) {
  if (all.grid == !all.map_file.empty())
    source.refuse(all.grid ? "map" : "",
                  all.grid
                      ? "map has no effect beside [street_grid]; remove one."
                      : "there are no streets: add map = \"FILE\" or a table "
                        "[street_grid].");
  if (all.grid) {
    all.world = world::make_street_grid(all.grid_params);
    return;
  }
  const auto file = folder / all.map_file;
  if (map_text)
    all.map_text = std::move(*map_text);
  else
    all.map_text = read_named(file, "map", source);
  all.read_from.push_back(file);
  all.world = known_map(all.map_text, file);
}

/// @returns a profile as all use it, with what vehicles wait for on their host.
std::shared_ptr<const channel::channel_profile>
complete(const scenario_definition& all, channel::channel_profile profile) {
  profile.vehicle_host =
      channel::wait_for_core(all.vehicle_host, all.vehicles());
  return std::make_shared<const channel::channel_profile>(std::move(profile));
}

/// Reads the maps that providers have of their own. Positions in messages
/// between the two sides are of one frame, so it has to be that of the
/// scenario's map.
void load_provider_maps(scenario_definition& all, const fs::path& folder,
                        const toml_file& source) {
  for (std::size_t k = 0; k < all.providers.size(); ++k) {
    auto& p = all.providers[k];
    if (p.map.empty())
      continue;
    if (p.has_no_map()) {
      p.streets = std::make_shared<const world::streets>();
      continue;
    }
    const auto key = fmt::format("provider.{}.map", k);
    const auto file = folder / p.map;
    p.map_text = read_named(file, key, source);
    all.read_from.push_back(file);
    p.streets = parse_map(p.map_text, file);
    if (p.streets->map.origin() != all.world->map.origin())
      source.refuse(key, fmt::format("the map {} has another origin than that "
                                     "of the scenario; give it the same.",
                                     file.string()));
  }
}

void load_trace(scenario_definition& all, const fs::path& folder,
                const toml_file& source) {
  constexpr std::string_view key = "network.trace";
  const auto file = folder / all.network.trace;
  auto filled = all.network.profile;
  try {
    all.trace_text = read_named(file, key, source);
    all.read_from.push_back(file);
    filled.trace = channel::parse_trace(all.trace_text);
  } catch (const std::invalid_argument& problem) {
    source.refuse(key, fmt::format("{}, {}.", file.string(), problem.what()));
  }
  all.network.channel = complete(all, std::move(filled));
}

void load_forecast(scenario_definition& all, const fs::path& folder,
                   const toml_file& source) {
  auto& forecast = all.policies.forecast;
  const auto file = folder / forecast.file;
  forecast.text = read_named(file, "policies.forecast.file", source);
  all.read_from.push_back(file);
  forecast.places = read_quality(file, all);
}

/// Finds programs, and reads what they get.
void load_programs(scenario_definition& all, const fs::path& folder,
                   const toml_file& source) {
  const auto try_to = [&source](const std::string& key, auto load) {
    try {
      load();
    } catch (const std::invalid_argument& problem) {
      source.refuse(key, fmt::format("{}.", problem.what()));
    }
  };
  const auto read = [&all](const fs::path& file) {
    const auto content = read_regular_file(file, longest_named);
    if (!content.refusal.empty())
      throw std::invalid_argument{fmt::format("the file {} cannot be read: {}",
                                              file.string(), content.refusal)};
    all.program_texts.push_back(
        content_key(file.filename().string(), content.text));
    all.read_from.push_back(file);
  };
  for (std::size_t k = 0; k < all.services.size(); ++k) {
    const auto& type = all.services[k];
    try_to(fmt::format("service.{}", k), [&] {
      type->load(folder);
      std::ranges::for_each(type->files(), read);
    });
  }
  for (std::size_t p = 0; p < all.providers.size(); ++p)
    for (std::size_t k = 0; k < all.providers[p].programs.size(); ++k) {
      auto& program = all.providers[p].programs[k].what;
      try_to(fmt::format("provider.{}.program.{}.command", p, k), [&] {
        program.locate(folder);
        std::ranges::for_each(program.files(), read);
      });
    }
}

/// Adds the providers that ride with vehicles.
void add_riders(scenario_definition& all) {
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto& fleet = all.fleets[f];
    if (!fleet.provide)
      continue;
    const auto cars = fleet.provide->is_in_all() ? fleet.count : 1;
    for (std::int64_t i = 0; i < cars; ++i) {
      const auto carrier = static_cast<station_id>(fleet.first_station + i);
      all.providers.push_back(fleet.provide->in_vehicle(carrier, f));
      all.providers.back().fails_at = fleet.fails_at;
    }
  }
}

/// They ride off where their vehicles start.
void place_riders(scenario_definition& all) {
  std::map<station_id, point> starts;
  for (const auto& v : place_vehicles(all))
    starts[v.station] = v.way->path().at(v.start_s_m).at;
  for (auto& p : all.providers)
    if (p.carrier)
      p.position_m = starts.at(p.carrier->station);
}

/// Gives everybody a channel, and computers as they fit to it.
void complete_networks(scenario_definition& all) {
  const auto share = [&all](network_options& network) {
    network.channel = complete(all, network.profile);
  };
  share(all.network);
  for (auto& p : all.providers) {
    if (p.network)
      share(*p.network);
    if (p.network && !p.compute)
      p.compute = all.compute.for_own_network();
    if (p.compute)
      p.compute->complete((p.network ? *p.network : all.network).profile.name);
  }
  all.compute.complete(all.network.profile.name);
}

/// Tells each note on stderr, of notes that say the same only the first: a
/// sweep loads one file again and again, and a report many alike.
void tell(const std::vector<option_note>& notes) {
  static std::mutex lock;
  static std::set<std::string> told;
  const std::lock_guard locked{lock};
  for (const auto& note : notes)
    if (told.insert(note.text).second)
      std::fprintf(stderr, "sofof: %s: %s\n", note.place.c_str(),
                   note.text.c_str());
}

/// @param is_run  As `load_policy_files` has it.
scenario_definition parse(std::string_view text, const fs::path& file,
                          std::span<const std::string> overrides, bool is_run,
                          std::optional<std::string> map_text = {}) {
  toml_file source{text, file.string()};
  for (const auto& assignment : overrides)
    source.set(assignment);
  scenario_definition all;
  source.read([&](option_visitor& s) { all.visit_options(s); });
  all.read_from.push_back(file);
  all.notes = source.notes();
  if (const auto grid = std::exchange(all.provider_grid, std::nullopt))
    for (auto& p : grid->all())
      all.providers.push_back(std::move(p));
  add_riders(all);
  complete_networks(all);
  const auto folder = file.parent_path();
  if (!all.network.trace.empty())
    load_trace(all, folder, source);
  if (!all.policies.forecast.file.empty())
    load_forecast(all, folder, source);
  load_policy_files(all, folder, source, is_run);
  load_world(all, folder, source, std::move(map_text));
  load_provider_maps(all, folder, source);
  check_whole(all, source);
  place_riders(all);
  if (is_run)
    load_programs(all, folder, source);
  return all;
}

} // namespace

scenario_definition parse_scenario(std::string_view text, const fs::path& file,
                                   std::span<const std::string> overrides) {
  return parse(text, file, overrides, false);
}

scenario_definition load_scenario(const fs::path& file,
                                  std::span<const std::string> overrides) {
  auto all = parse(require_text(file), file, overrides, true);
  tell(all.notes);
  return all;
}

scenario_definition load_with_map(std::string_view text, std::string map_text,
                                  const fs::path& file,
                                  std::span<const std::string> overrides) {
  return parse(text, file, overrides, true, std::move(map_text));
}

} // namespace sofof::scenario
