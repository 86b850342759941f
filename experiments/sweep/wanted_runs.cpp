// Loading all points, so that all mistakes are known before anything runs.
#include "experiments/sweep/wanted_runs.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "experiments/sweep/run_store.hpp"
#include "scenario/load.hpp"
#include "scenario/placement.hpp"
#include "scenario/running_programs.hpp"

#include <fmt/format.h>

#include <exception>
#include <set>

namespace sofof::experiments {

namespace {

/// Vehicle cycles, and something for making a world.
double cost_of(const scenario::scenario_definition& s) {
  constexpr double setup = 1000;
  auto cycles = setup;
  const auto vehicles = static_cast<double>(scenario::place_vehicles(s).size());
  for (const auto& type : s.services)
    cycles +=
        vehicles * to_seconds(s.length) / to_seconds(type->options.period);
  return cycles;
}

} // namespace

wanted_runs runs_wanted_by(const sweep_plan& plan, std::string_view program,
                           const std::atomic<bool>& interrupted) {
  const auto points = points_of(plan);
  const auto base = read_text(plan.scenario).value_or("");
  wanted_runs all;
  std::set<std::string> met;
  std::string first_problem;
  for (std::size_t i = 0; i < points.size() && !interrupted; ++i) {
    const auto& point = points[i];
    const auto described = describe(plan, point);
    check_given_once(plan, point, base);
    auto& name = all.run_of.emplace_back();
    try {
      const auto s = scenario::load_scenario(plan.scenario, point.given);
      name = name_of_run(s, program);
      if (met.insert(name).second)
        all.runs.push_back({name, plan.scenario, point.given,
                            fmt::format("point {} ({})", i + 1, described),
                            cost_of(s),
                            plan.measures && point.seed == plan.seeds.front(),
                            scenario::unrepeatable_program(s)});
    } catch (const std::exception& problem) {
      if (first_problem.empty())
        first_problem =
            fmt::format("{} because: {}", described, problem.what());
      all.problems.push_back(fmt::format("point {} ({}) failed: {}", i + 1,
                                         described, problem.what()));
    }
  }
  // The mistake is none of a point then, but of the file.
  if (all.problems.size() == points.size())
    throw input_error{fmt::format("none of {} points can be run; {}",
                                  points.size(), first_problem)};
  return all;
}

} // namespace sofof::experiments
