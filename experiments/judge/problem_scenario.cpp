// A planning problem as a scenario of ours.
#include "experiments/judge/problem_scenario.hpp"

#include "base/options/toml_text.hpp"
#include "experiments/judge/ks_model.hpp"
#include "experiments/judge/speed_advice.hpp"
#include "scenario/load.hpp"
#include "scenario/map_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace sofof::experiments::judge {

namespace {

/// The drive goes on for so long after the last goal's time, s.
constexpr auto afterwards_s = 0.1;

double to_deg(double angle_rad) {
  return wrap_angle(angle_rad) * 180 / std::numbers::pi;
}

void move(std::vector<point>& all, point by) {
  for (auto& p : all)
    p = p - by;
}

void move(maps::planning_problem& problem, point by) {
  problem.at = problem.at - by;
  for (auto& goal : problem.goals)
    for (auto& place : goal.places) {
      move(place.corners, by);
      place.centre = place.centre - by;
    }
}

void move(maps::commonroad_scene& scene, point by) {
  for (auto& body : scene.bodies)
    for (auto& x : body.states)
      x.at = x.at - by;
  for (auto& house : scene.houses)
    move(house, by);
  for (auto& lanelet : scene.lanelets)
    move(lanelet, by);
  for (auto& problem : scene.problems)
    move(problem, by);
}

std::string house_text(const std::vector<point>& corners) {
  std::string text;
  for (const auto p : corners)
    text += fmt::format("{}[{:.3f}, {:.3f}]", text.empty() ? "" : ", ", p.x_m,
                        p.y_m);
  return fmt::format("\n[[building]]\ncorners_m = [{}]\n", text);
}

std::string map_text(const maps::imported_map& map,
                     const maps::commonroad_scene& scene) {
  auto text = maps::to_toml(map);
  for (const auto& house : scene.houses)
    text += house_text(house);
  return text;
}

void put_body(std::string& text, const maps::scene_body& body, int begin,
              double step_s) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "\n[[obstacle]] # {}\nlength_m = {:.3f}\n"
                 "width_m = {:.3f}\n",
                 quoted_toml(body.id), body.length_m, body.width_m);
  const auto& first = body.states.front();
  if (!body.moves) {
    fmt::format_to(out, "position_m = [{:.4f}, {:.4f}]\nheading_deg = {:.4f}\n",
                   first.at.x_m, first.at.y_m, to_deg(first.heading_rad));
    return;
  }
  text += "moment = [\n";
  for (const auto& x : body.states)
    fmt::format_to(out,
                   "  {{ t_s = {:.3f}, position_m = [{:.4f}, {:.4f}], "
                   "heading_deg = {:.4f}, speed_mps = {:.4f} }},\n",
                   step_s * (x.step - begin), x.at.x_m, x.at.y_m,
                   to_deg(x.heading_rad),
                   std::clamp(x.speed_mps, -50.0, 100.0));
  text += "]\n";
}

/// Where a car is beside its way.
struct place_on_way {
  double s_m, left_m, turn_rad; ///< Of the rear axle.
};

place_on_way place_on(const world::route& way,
                      const maps::planning_problem& problem) {
  const point ahead{std::cos(problem.heading_rad),
                    std::sin(problem.heading_rad)};
  // The way may come near its begin once more.
  const auto about = way.path().project(problem.at).s_m;
  const auto at = way.path().project(problem.at - axle_to_middle_m * ahead,
                                     about - axle_to_middle_m);
  return {at.s_m, at.d_m,
          wrap_angle(problem.heading_rad - way.path().at(at.s_m).heading_rad)};
}

std::string scenario_text(const problem_scenario& what,
                          const std::string& map_file) {
  const auto& problem = what.problem;
  const auto step_s = what.scene.step_s;
  const auto at = place_on(*what.way, problem);
  auto text = fmt::format(
      "# A planning problem of CommonRoad, for a car of ours.\n\n"
      "name = {}\nduration = \"{:.0f}ms\"\nmap = {}\n\n[traffic]\n"
      "crossings = \"perceived\"\n\n[record]\ntracks_period = \"10ms\"\n\n"
      "[[fleet]]\nfirst_station = 1\nroutes = [\"{}\"]\nconnected = false\n"
      "start_m = {:.4f}\nstart_speed_mps = {:.4f}\nstart_over_limit = true\n"
      "start_left_m = {:.4f}\nstart_turn_deg = {:.4f}\n\n[[service]]\nname = "
      "\"trajectory_planning\"\n",
      quoted_toml(what.name),
      1000 * (step_s * (problem.end() - problem.begin) + afterwards_s),
      quoted_toml(map_file), way_name, std::max(0.0, at.s_m), problem.speed_mps,
      at.left_m, to_deg(at.turn_rad));
  for (const auto& body : what.scene.bodies)
    put_body(text, body, problem.begin, step_s);
  return text;
}

/// Drops what is over before the drive begins.
void drop_past(maps::commonroad_scene& scene, int begin) {
  for (auto& body : scene.bodies)
    if (body.moves)
      std::erase_if(body.states,
                    [begin](const auto& x) { return x.step < begin; });
  std::erase_if(scene.bodies,
                [](const auto& body) { return body.states.empty(); });
}

} // namespace

std::variant<problem_scenario, no_way>
make_scenario(const maps::imported_map& map, maps::commonroad_scene scene,
              const maps::planning_problem& problem,
              const std::filesystem::path& file,
              std::span<const std::string> changes) {
  problem_scenario made;
  made.problem = problem;
  made.middle = map.middle;
  move(made.problem, map.middle);
  move(scene, map.middle);
  drop_past(scene, problem.begin);
  made.scene = std::move(scene);
  made.name = file.stem().string();
  auto found = choose_way(map, made.problem);
  if (auto* why = std::get_if<no_way>(&found))
    return *why;
  auto& drawn = std::get<maps::imported_map>(found);
  const auto map_file = file.stem().string() + "_map.toml";
  const auto streets = scenario::parse_map(map_text(drawn, made.scene),
                                           file.parent_path() / map_file);
  made.way = streets->find(way_name);
  advise_speeds(drawn, made.problem, made.scene.step_s, *made.way,
                place_on(*made.way, made.problem).s_m + axle_to_middle_m);
  made.map_text = map_text(drawn, made.scene);
  made.text = scenario_text(made, map_file);
  made.scenario =
      scenario::load_with_map(made.text, made.map_text, file, changes);
  made.way = made.scenario.world->find(way_name);
  return made;
}

} // namespace sofof::experiments::judge
