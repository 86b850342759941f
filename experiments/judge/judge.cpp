// Judges how cars of ours drive in scenarios of CommonRoad.
#include "experiments/judge/judge.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/text/printable.hpp"
#include "experiments/judge/drive.hpp"
#include "experiments/judge/solution.hpp"

#include <fmt/format.h>

#include "maps/import.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sofof::experiments::judge {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_source = std::size_t{64} << 20;

/// Nobody drives a problem for longer, s.
constexpr auto longest_problem_s = 600.0;

/// @returns a file name of what somebody else has chosen.
std::string plain_name(std::string_view text) {
  constexpr std::size_t longest = 100;
  std::string name;
  for (const auto c : text.substr(0, longest))
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
  return name.empty() ? "scenario" : name;
}

world::vehicle_state start_of(const maps::planning_problem& problem) {
  const point ahead{std::cos(problem.heading_rad),
                    std::sin(problem.heading_rad)};
  return {.at = problem.at - axle_to_middle_m * ahead,
          .heading_rad = problem.heading_rad,
          .speed_mps = problem.speed_mps};
}

double driven_m(std::span<const driven_moment> drive, double until_s) {
  auto sum_m = 0.0;
  for (std::size_t i = 1; i < drive.size() && drive[i].t_s <= until_s; ++i)
    sum_m += distance_m(drive[i - 1].car.at, drive[i].car.at);
  return sum_m;
}

judged refused(const std::string& file, const std::string& why) {
  judged row;
  row.file = file;
  row.scenario = fs::path{file}.filename().string();
  row.found = {.what = outcome::refused, .why = why};
  return row;
}

} // namespace

judged_counts::judged_counts(std::span<const judged> rows)
    : all{rows.size()},
      by_outcome(static_cast<std::size_t>(last_outcome) + 1, 0) {
  for (const auto& row : rows) {
    ++by_outcome[static_cast<std::size_t>(row.found.what)];
    if (row.found.what == outcome::collided && row.found.own_fault)
      ++own_fault;
  }
}

std::vector<judged> judge::look_at(const std::string& file) {
  try {
    return try_file(file);
  } catch (const storage_error&) {
    throw;
  } catch (const input_error& problem) {
    return {refused(file, problem.what())};
  }
}

std::vector<judged> judge::try_file(const std::string& file) {
  const auto text = require_text(file, longest_source);
  const maps::xml_file parsed{text, file};
  if (std::string_view{parsed.root().name()} != "commonRoad")
    parsed.refuse(parsed.root(), "this is no scenario of CommonRoad.");
  const auto scene = maps::read_commonroad_scene(parsed);
  if (scene.problems.empty())
    parsed.refuse(parsed.root(), "there is no <planningProblem>: nothing is to "
                                 "be driven.");
  for (const auto& problem : scene.problems)
    if ((problem.end() - problem.begin) * scene.step_s > longest_problem_s)
      parsed.refuse(parsed.root(),
                    fmt::format("planning problem {} lasts for more than {} s.",
                                problem.id, longest_problem_s));
  const auto map =
      maps::import({text, file}, plain_name(fs::path{file}.stem().string()));
  std::vector<judged> rows;
  for (const auto& problem : scene.problems)
    rows.push_back(try_problem(map, scene, problem, file));
  return rows;
}

judged judge::try_problem(const maps::imported_map& map,
                          const maps::commonroad_scene& scene,
                          const maps::planning_problem& problem,
                          const std::string& file) {
  judged row;
  row.file = file;
  row.scenario = scene.benchmark;
  row.problem = problem.id;
  const auto stem = plain_name(fs::path{file}.stem().string());
  const auto name =
      new_name(scene.problems.size() == 1
                   ? stem
                   : fmt::format("{}_{}", stem, plain_name(problem.id)));
  const auto made = make_scenario(
      map, scene, problem, options_.out.value_or(fs::path{}) / (name + ".toml"),
      options_.changes);
  if (const auto* none = std::get_if<no_way>(&made)) {
    row.found = {.what = outcome::no_route, .why = none->why};
    return row;
  }
  const auto& what = std::get<problem_scenario>(made);
  write(name + "_map.toml", what.map_text);
  write(name + ".toml", what.text);
  const drive_judge by{what};
  try {
    const auto moments =
        drive(what.scenario, start_of(what.problem), [&by](const auto& so_far) {
          return by.look(so_far).has_value();
        });
    const auto found = by.look(moments);
    row.found = found ? *found : by.give_up(moments);
    row.way_m = driven_m(moments, row.found.at_s);
    if (row.found.what != outcome::reached)
      return row;
    auto states = by.states(moments);
    std::erase_if(states, [last = row.found.step](const auto& x) {
      return x.step > last;
    });
    row.limit = broken_limit(states, scene.step_s).value_or("");
    if (!row.limit.empty() || scene.problems.size() > 1 || !options_.out)
      return row;
    row.solution = fmt::format("solution_KS2_SM1_{}.xml", name);
    write(row.solution, solution_xml(scene.benchmark, scene.version, problem.id,
                                     states, what.middle));
  } catch (const storage_error&) {
    throw;
  } catch (const std::runtime_error& problem_of_run) {
    row.found = {.what = outcome::refused, .why = problem_of_run.what()};
  }
  return row;
}

void judge::write(const std::string& name, const std::string& text) const {
  if (options_.out)
    write_file(*options_.out / name, text);
}

std::string judge::new_name(const std::string& wanted) {
  auto name = wanted;
  for (auto k = 2; !names_.insert(name).second; ++k)
    name = fmt::format("{}_{}", wanted, k);
  return name;
}

} // namespace sofof::experiments::judge
