// One planner at work, cycle by cycle, along one route.
#include "actors/services/planning/plan_cycle.hpp"

#include <cstdio>
#include <cstdlib>
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
      scene_{world.roads->lanes(),
             way_,
             {.judges_crossings = !world.crossings_granted,
              .sees_opposite_m = world.eyes.range_m,
              .houses = &world.roads->houses()}} {}

planners::plan_report plan_cycle::run(time_point now,
                                      planners::planning_input from,
                                      std::span<const planners::track> others,
                                      std::span<const planners::told_drive>
                                          told) {
  const planners::own_place me{station_, from.s_m, from.d_m, from.speed_mps};
  scene_.describe(now, me, others, from.others, told);
  const auto start = clock_();
  const auto in_time = [&](int) { return clock_() - start < deadline; };
  auto report = planner_->plan(now, from, plan_.empty() ? nullptr : &plan_,
                               next_, planners::ocp::budget{in_time});
  std::swap(plan_, next_);
  if (const char* w = std::getenv("PLAN"); w && std::strtoul(w, nullptr, 10) == station_.value()) {
    const auto& o = from.others; const auto t = to_seconds(now - time_point{});
    std::printf("PLAN t %.2f s %.2f v %.2f a %.2f emer %d late %d origin %d lead %.1f v %.1f told %zu cross %zu beside %zu stop %.1f agreed %d wait %.1f", t, from.s_m, from.speed_mps, from.accel_mps2, report.emergency, report.is_late, (int)report.origin, o.lead ? o.lead->rear_s_m - from.s_m - 4.02 : -1, o.lead ? o.lead->speed_mps : -1, o.lead_told.size(), o.crossings.size(), o.beside.size(), o.stop_at_m ? *o.stop_at_m - from.s_m : -1, o.agreed.has_value(), o.agreed && o.agreed->waits_at_m ? *o.agreed->waits_at_m - from.s_m : -1);
    if (o.agreed) for (std::size_t i = 0; i < o.agreed->axle.size() && i < 40; i += 8) std::printf(" [%.1f@%.2f]", o.agreed->axle[i].s_m - from.s_m, o.agreed->axle[i].t_s);
    for (auto& c : o.crossings) std::printf(" {%.1f-%.1f %.1f..%.1f f%d b%x}", c.from_m - from.s_m, c.to_m - from.s_m, c.enter_s, c.leave_s, c.goes_first, c.body);
    std::printf(" plan v1 %.2f v2 %.2f\n", plan_.at(now + std::chrono::seconds{1}).speed_mps, plan_.at(now + std::chrono::seconds{2}).speed_mps);
  }
  return report;
}

} // namespace sofof::actors
