// One planner at work, cycle by cycle, along one route.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "planners/scene/scene_interpreter.hpp"
#include "planners/scene/track.hpp"

#include <cassert>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace sofof::actors {

/// @param where  offloading::vehicle_context, or that of a provider.
/// @returns what tells a cycle how long it has taken; null where no time passes
/// in it.
std::function<time_point()> stopwatch_of(const auto& where) {
  return where.virtual_time ? std::function<time_point()>{} : where.clock;
}

/// @param from_m  About where the vehicle is on that route.
/// @returns what of a plan along another route leads along this one, from the
/// plan's start on.
world::trajectory plan_along(const world::route& way, double from_m,
                             world::trajectory plan);

/// What planning in vehicles and at providers has in common: the planner, its
/// last plan, and what it makes of the others.
class plan_cycle {
public:
  /// @param stopwatch    Where time is real, the time; else null.
  /// @param at_provider  Whether it may plan more thoroughly.
  plan_cycle(const planning_world& world, station_id station,
             std::function<time_point()> stopwatch, bool at_provider,
             world::route_ptr way);

  const world::route_ptr& way() const { return way_; }

  /// @returns the last plan; empty before the first.
  const world::trajectory& plan() const { return plan_; }

  /// Another source has planned, and its plan is in use.
  /// @param other  Sound.
  void take_over(const world::trajectory& other) {
    assert(!other.empty());
    plan_ = other;
  }

  /// Nobody drives the last plan any more.
  void forget_plan() { plan_.points.clear(); }

  /// Plans from here, given what is known of the others. `from.others` is
  /// filled in, but for what it says of stopping and of what was agreed.
  planners::plan_report run(time_point now, planners::planning_input from,
                            std::span<const planners::track> others,
                            std::span<const planners::told_drive> told = {});

  /// The same in a scene that somebody else has described: `from.others`.
  planners::plan_report run_in_scene(time_point now,
                                     const planners::planning_input& from);

private:
  station_id station_;
  std::function<time_point()> stopwatch_;
  world::route_ptr way_;
  std::unique_ptr<planners::trajectory_planner> planner_;
  planners::scene_interpreter scene_;
  world::trajectory plan_;
};

} // namespace sofof::actors
