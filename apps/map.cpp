// sofof map: draws a map, or that of a scenario.
#include "apps/command.hpp"
#include "apps/find_scenario.hpp"
#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/load.hpp"
#include "scenario/map_file.hpp"
#include "world/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include "maps/picture.hpp"
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace sofof::apps {

namespace {

/// Whether it has lanes, and nothing that only a scenario has.
bool is_map(const std::string& file) {
  try {
    refuse_map(file);
  } catch (const input_error&) {
    return true;
  }
  return false;
}

/// A picture is not written over what it is drawn of, nor over other files.
void check_picture(const std::string& file, const std::filesystem::path& out) {
  if (out.extension() != ".svg")
    throw input_error{fmt::format("{}: a picture is an SVG file; choose a name "
                                  "that ends with .svg.",
                                  out.string())};
  std::error_code none;
  if (std::filesystem::equivalent(file, out, none))
    throw input_error{fmt::format("{} is what the picture is drawn of; choose "
                                  "another file with -o.",
                                  out.string())};
}

void draw_map(const std::string& name, const std::string& out) {
  const auto file = find_scenario(name);
  check_picture(file, out);
  world::streets_ptr world;
  maps::picture_additions more;
  if (is_map(file)) {
    world = scenario::parse_map(require_text(file), file);
  } else {
    const auto all = scenario::load_scenario(file);
    world = all.world;
    for (const auto& p : all.providers) {
      more.providers.push_back({p.name, p.position_m, p.area().corners()});
    }
  }
  auto ways = world->routes; // and lanes that no route leads over
  for (const auto& l : world->map.lanes())
    ways.push_back(
        world->map.make_route(l.name, std::vector<std::string>{l.name}, false));
  const world::vehicle_params car;
  more.bends = world::sharp_bends(
      world->map, ways, car.wheelbase_m / std::tan(car.max_steer_rad));
  write_file(out, maps::draw(*world, more), "another file with -o");
  std::cout << out << '\n';
}

} // namespace

void add_map(CLI::App& app, int&) {
  struct arguments {
    std::string file, out;
  };
  auto* command = app.add_subcommand("map", "Draw a map, or a scenario's map");
  auto args = std::make_shared<arguments>();
  command
      ->add_option("FILE", args->file,
                   "Map or scenario file (TOML), or its name in config/")
      ->required()
      ->type_name(" ");
  command->add_option("-o", args->out, "Where to: the picture, FILE.svg")
      ->type_name("FILE.svg")
      ->required();
  command->footer("Example:\n  sofof map config/ulm_lehr.toml -o ulm.svg");
  command->callback([args] { draw_map(args->file, args->out); });
}

} // namespace sofof::apps
