// What a vehicle and the planner in it say to each other.
#pragma once

#include "actors/services/planning/known_others.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/protocol/service.hpp"
#include "planners/crossing/agreed.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/trajectory.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sofof::actors {

/// Please plan along this route from this state.
struct plan_request {
  std::string way;               ///< Name of the route.
  planners::planning_input from; ///< What it knows of others stays here.
  world::perception seen;        ///< By the vehicle, and granted to it.
  messages::cam own;             ///< Its motion as its CAMs tell it.
  /// What was agreed at a crossing; stays here. Null: nothing.
  std::shared_ptr<const planners::crossing_view> crossing;
  chain_findings found; ///< Before it, in a chain.

  planners::agreeing_car agreeing(const world::vehicle_params& car) const {
    return {from.s_m, from.speed_mps, car.front_m};
  }

  /// @returns where its front has to stop: a crossing was not granted, or what
  /// was agreed does not bind.
  std::optional<double> stop_at_m(const world::vehicle_params& car) const {
    auto stop_m = seen.stop_at_m;
    if (!crossing)
      return stop_m;
    const auto line_m = planners::waiting_line_m(*crossing, agreeing(car));
    return stop_m && line_m ? std::min(*stop_m, *line_m)
           : line_m         ? line_m
                            : stop_m;
  }
};

void visit_fields(auto& v, plan_request& x) {
  v("way", x.way);
  v("from", x.from);
  v("seen", x.seen);
  v("own", x.own);
}

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::plan_request> = "plan_request";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::planners::crossing_view> =
        "crossing_view";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::world::trajectory> = "trajectory";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::planners::plan_report> = "plan_report";
