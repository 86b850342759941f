// One planner at work, cycle by cycle, along one route.
#include "actors/services/planning/plan_cycle.hpp"

#include <cmath>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// Trying harder than this helps nobody who waits.
constexpr duration deadline = 2ms;

} // namespace

world::trajectory plan_along(const world::route& way, double from_m,
                             world::trajectory plan) {
  constexpr double same_way_m = 1;
  auto guess_m = from_m;
  auto& points = plan.points;
  for (auto p = points.begin(); p != points.end(); ++p) {
    const auto foot = way.path().project(p->at, guess_m);
    if (std::hypot(foot.d_m, foot.beyond_m) > same_way_m) {
      points.erase(p, points.end());
      break;
    }
    guess_m = p->s_m = foot.s_m;
  }
  return plan;
}

plan_cycle::plan_cycle(const planning_world& world, station_id station,
                       std::function<time_point()> stopwatch, bool at_provider,
                       world::route_ptr way)
    : station_{station}, stopwatch_{std::move(stopwatch)}, way_{std::move(way)},
      planner_{world.options.make(way_, *world.roads, at_provider)},
      scene_{world.roads->way(way_), world.look()} {}

planners::plan_report
plan_cycle::run(time_point now, planners::planning_input from,
                std::span<const planners::track> others,
                std::span<const planners::told_drive> told) {
  const planners::own_place me{station_, from.s_m, from.d_m, from.speed_mps};
  scene_.describe(now, me, others, from.others, told);
  return run_in_scene(now, from);
}

planners::plan_report
plan_cycle::run_in_scene(time_point now, const planners::planning_input& from) {
  const auto start = stopwatch_ ? stopwatch_() : now;
  static thread_local world::trajectory next; // room that is used again
  const auto in_time = [&](int) { return stopwatch_() - start < deadline; };
  auto report = planner_->plan(
      now, from, plan_.empty() ? nullptr : &plan_, next,
      stopwatch_ ? planners::ocp::budget{in_time} : planners::ocp::budget{});
  std::swap(plan_, next);
  return report;
}

} // namespace sofof::actors
