// One planner at work, cycle by cycle, along one route.
#include "actors/services/planning/plan_cycle.hpp"

#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// Trying harder than this helps nobody who waits; only where time is real.
constexpr duration deadline = 2ms;

} // namespace

plan_cycle::plan_cycle(const planning_world& world, station_id station,
                       std::function<time_point()> clock, bool at_provider,
                       world::route_ptr way)
    : station_{station}, clock_{std::move(clock)}, way_{std::move(way)},
      planner_{world.options.make(way_, *world.roads, at_provider)},
      scene_{world.roads->lanes(), way_, world.look()} {}

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
  const auto start = clock_();
  const auto in_time = [&](int) { return clock_() - start < deadline; };
  auto report = planner_->plan(now, from, plan_.empty() ? nullptr : &plan_,
                               next_, planners::ocp::budget{in_time});
  std::swap(plan_, next_);
  return report;
}

} // namespace sofof::actors
