// A planning problem as a scenario of ours.
#pragma once

#include "experiments/judge/problem_way.hpp"
#include "scenario/scenario.hpp"
#include "world/roads/route.hpp"

#include "maps/commonroad_scene.hpp"
#include "maps/imported_map.hpp"
#include <filesystem>
#include <span>
#include <string>
#include <variant>

namespace sofof::experiments::judge {

/// One car on its way, among the obstacles of the file.
struct problem_scenario {
  std::string name;
  std::string map_text, text;             ///< As files.
  scenario::scenario_definition scenario; ///< Of these.
  world::route_ptr way;
  maps::planning_problem problem; ///< In the map's frame.
  maps::commonroad_scene scene;   ///< Likewise; of bodies those that count.
  point middle;                   ///< Of the map's frame, in the file's.
};

/// @param map      The lanes of the file.
/// @param scene    The rest, in the file's own frame.
/// @param problem  One of it.
/// @param file     Where the scenario's file would be; the map's stands beside.
/// @param changes  KEY=VALUE, of the scenario.
/// @throws input_error when this cannot be a scenario.
std::variant<problem_scenario, no_way>
make_scenario(const maps::imported_map& map, maps::commonroad_scene scene,
              const maps::planning_problem& problem,
              const std::filesystem::path& file,
              std::span<const std::string> changes);

} // namespace sofof::experiments::judge
