// One planner at work, cycle by cycle, along one route.
#include "actors/services/planning/plan_cycle.hpp"

#include <utility>

namespace sofof {

namespace {

using namespace std::chrono_literals;

/// Trying harder than this helps nobody who waits; only where time is real.
constexpr duration deadline = 2ms;

} // namespace

plan_cycle::plan_cycle(const service_setup& setup,
                       const planner_options& options, known_roads& roads,
                       route_ptr way)
    : setup_{setup}, way_{std::move(way)}, planner_{options.make(way_, roads,
                                                                 setup.remote)},
      scene_{
          roads.lanes(), way_, {.judges_crossings = !setup.crossings_granted}} {
}

plan_report plan_cycle::run(time_point now, planning_input from,
                            std::span<const track> others) {
  const auto stop_at_m = from.others.stop_at_m;
  const own_place me{setup_.station, from.s_m, from.d_m};
  scene_.describe(now, me, others, from.others);
  from.others.stop_at_m = stop_at_m;
  const auto start = setup_.clock();
  const auto in_time = [&](int) { return setup_.clock() - start < deadline; };
  auto report = planner_->plan(now, from, plan_.empty() ? nullptr : &plan_,
                               next_, ocp::budget{in_time});
  std::swap(plan_, next_);
  report.extremes = extremes_of(plan_);
  return report;
}

} // namespace sofof
