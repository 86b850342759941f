// What is tried: a scenario, and foul play in it.
#include "experiments/torture/tried_scenario.hpp"

#include "actors/simulation/hostile_station.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_nodes.hpp"
#include "scenario/build.hpp"
#include "scenario/load.hpp"
#include "scenario/run.hpp"
#include "scenario/runtime.hpp"

#include <fmt/format.h>

#include <atomic>
#include <memory>
#include <ostream>
#include <utility>

namespace sofof::experiments::torture {

namespace {

/// Takes a table out of a file. @returns its options, if it is there.
template <class Options>
std::optional<Options> extract(toml::table& all, const std::string& key,
                               const std::filesystem::path& file) {
  const auto* table = all[key].as_table();
  if (!table)
    return std::nullopt;
  Options options;
  toml_file{file_text(*table), fmt::format("{}: [{}]", file.string(), key)}
      .read([&options](option_visitor& s) { options.visit_options(s); });
  all.erase(key);
  return options;
}

/// Round all vehicles and providers, about.
constexpr point town_m{500, 500};

} // namespace

loaded_scenario load(const tried_scenario& tried) {
  auto all = parse_toml(tried.text, tried.file.string());
  loaded_scenario found;
  found.lies = extract<lie_options>(all, "lies", tried.file);
  found.hostile = extract<hostile_options>(all, "hostile", tried.file);
  // Mistakes have their places in the file, where nothing was taken out.
  const auto is_whole = !found.lies && !found.hostile;
  found.what = scenario::parse_scenario(is_whole ? tried.text : file_text(all),
                                        tried.file);
  found.what.record.trace = true;
  if (!found.lies)
    return found;
  const auto* planning = scenario::planning_service(found.what);
  const auto of_chain = chain_lie_of(found.lies->what);
  for (auto& type : found.what.services)
    if (of_chain && type->name() == liar_of(*of_chain))
      type = lying_chain(type, *of_chain, found.lies->after);
    else if (!of_chain && type.get() == planning)
      type = lying_service(type, lie_of(found.lies->what).value(),
                           found.lies->after);
  return found;
}

std::uint64_t run(const loaded_scenario& s,
                  const std::filesystem::path& folder) {
  const std::atomic<bool> interrupted{false};
  std::ostream nowhere{nullptr};
  scenario::run_options how;
  how.out = folder;
  how.time_decisions = false;
  const auto said = std::make_shared<std::atomic<std::uint64_t>>(0);
  const auto time = scenario::make_virtual_runtime();
  scenario::run_part(
      s.what, how, {}, *time, interrupted, nowhere,
      [&](const scenario::world_actors& world) {
        if (s.hostile && !world.providers.empty())
          actors::spawn_hostile_station(
              time->system(),
              {world.providers, s.hostile->every, point{-50, -50}, town_m,
               std::make_shared<const messages::georeference>(
                   messages::geo_frame{s.what.world->map.origin()},
                   time->clock()),
               random_stream{static_cast<std::uint64_t>(s.what.seed),
                             "hostile"},
               said});
      });
  return *said;
}

} // namespace sofof::experiments::torture
