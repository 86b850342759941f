// sofof import: makes a map of one of another format.
#include "maps/import.hpp"

#include "apps/command.hpp"
#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_text.hpp"
#include "scenario/load.hpp"
#include "scenario/map_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace sofof::apps {

namespace {

namespace fs = std::filesystem;

/// Networks of cities have some tens of megabytes.
constexpr std::size_t longest_source = std::size_t{256} << 20;
constexpr std::string_view choose = "another file with -o";

struct import_arguments {
  std::string file, routes, out, name;
};

/// @returns the name without all endings: "city.net.xml" is "city".
std::string stem_of(const fs::path& file) {
  const auto name = file.filename().string();
  return name.substr(0, name.find('.', 1));
}

void tell(const maps::imported_map& map, const world::streets& made,
          const std::string& out) {
  const auto all_m = std::accumulate(
      map.lanes.begin(), map.lanes.end(), 0.0,
      [](double sum, const auto& l) { return sum + length_m(l.centre); });
  std::cout << fmt::format("{}: {} lanes, {:.1f} km, {} conflicts, {} routes\n",
                           out, map.lanes.size(), all_m / 1000,
                           made.map.conflicts().size(), map.routes.size());
  for (const auto& [what, count] : map.left_out)
    std::cout << fmt::format("  left out: {} ({})\n", what, count);
  for (const auto& warning : map.warnings)
    std::fputs(fmt::format("sofof: {}\n", warning).c_str(), stderr);
}

void refuse_longer(const std::string& text, const std::string& source,
                   std::string_view as) {
  if (text.size() > longest_input)
    throw input_error{fmt::format("{}: as {} it would have {} MB, more than "
                                  "{}; cut a part out of it first (netconvert "
                                  "--keep-edges.in-boundary).",
                                  source, as, text.size() >> 20,
                                  longest_input >> 20)};
}

/// @returns where the scenario of a map's vehicles goes.
fs::path traffic_file(const fs::path& map) {
  return fs::path{map}.replace_filename(map.stem().string() + "_traffic.toml");
}

/// Refuses a file that somebody has written by hand, or edited.
void refuse_other(const fs::path& file, const std::string& text) {
  std::error_code none;
  if (fs::exists(file, none) && read_text(file.string()) != text)
    throw input_error{fmt::format(
        "{} is there already, and is another scenario; remove it, or choose "
        "{}.",
        file.string(), choose)};
}

/// Refuses what its source makes of `check`, with the source's name in front:
/// the file of the mistake's place does not exist.
template <class F>
auto made_of(const std::string& source, F check) {
  try {
    return check();
  } catch (const input_error& problem) {
    throw input_error{fmt::format("{}: nothing is written; of it would come {}",
                                  source, problem.what())};
  }
}

/// Reads a scenario on a map that is not there yet: it is, under another name,
/// for as long as this takes.
void check_scenario(const std::string& text, const fs::path& file,
                    const fs::path& map, const std::string& map_text) {
  auto draft = map;
  draft.replace_filename(
      fmt::format(".{}.{}.toml", map.stem().string(), getpid()));
  write_file(draft, map_text, choose);
  std::error_code none;
  try {
    const std::vector overrides{"map="
                                + quoted_toml(draft.filename().string())};
    scenario::parse_scenario(text, file, overrides);
  } catch (...) {
    fs::remove(draft, none);
    throw;
  }
  fs::remove(draft, none);
}

void import_map(const import_arguments& args) {
  const auto source = require_text(args.file, longest_source);
  maps::named_text routes;
  std::string demand;
  if (!args.routes.empty()) {
    demand = require_text(args.routes, longest_source);
    routes = {demand, args.routes};
  }
  const fs::path out{args.out};
  if (out.extension() != ".toml")
    throw input_error{fmt::format("{}: a map is a TOML file; choose a name "
                                  "that ends with .toml.",
                                  args.out)};
  output_file::check(out, choose);
  const auto name = args.name.empty() ? stem_of(args.file) : args.name;
  const auto map = maps::import({source, args.file}, name, routes);
  const auto text = maps::to_toml(map);
  refuse_longer(text, args.file, "a map");
  const auto made =
      made_of(args.file, [&] { return scenario::parse_map(text, args.out); });
  const auto traffic = traffic_file(out);
  std::string vehicles;
  if (!map.departures.empty()) {
    vehicles = maps::to_scenario(map, out.filename().string());
    refuse_longer(vehicles, args.routes, "a scenario");
    output_file::check(traffic, choose);
    refuse_other(traffic, vehicles);
    made_of(args.routes, [&] { check_scenario(vehicles, traffic, out, text); });
  }
  write_file(out, text, choose);
  tell(map, *made, args.out);
  if (map.departures.empty())
    return;
  write_file(traffic, vehicles, choose);
  std::cout << fmt::format("{}: {} vehicles\n", traffic.string(),
                           map.departures.size());
}

} // namespace

void add_import(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "import", "Make a map of one of SUMO, Lanelet2 or CommonRoad");
  auto args = std::make_shared<import_arguments>();
  command
      ->add_option("FILE", args->file,
                   "Network of SUMO (.net.xml), Lanelet2 map (.osm) or "
                   "CommonRoad scenario (.xml)")
      ->required()
      ->type_name(" ");
  command->add_option("-o", args->out, "Where to: the map, MAP.toml")
      ->type_name("MAP.toml")
      ->required();
  command
      ->add_option("--routes", args->routes,
                   "Routes of SUMO (.rou.xml), which become the map's; its "
                   "vehicles become the scenario MAP_traffic.toml")
      ->type_name("FILE");
  command
      ->add_option("--name", args->name,
                   "What to call the map; without: as FILE, without endings")
      ->type_name("NAME");
  command->footer("Example:\n  sofof import city.net.xml -o city.toml");
  command->callback([args] { import_map(*args); });
}

} // namespace sofof::apps
