// What a vehicle and the planner in it say to each other.
#pragma once

#include "messages/protocol/payload.hpp"
#include "messages/protocol/service.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/trajectory.hpp"

#include <string>
#include <vector>

namespace sofof::actors {

/// Please plan along this route from this state.
struct plan_request {
  std::string way;               ///< Name of the route.
  planners::planning_input from; ///< What it knows of others stays here.
  world::perception seen;        ///< By the vehicle, and granted to it.
  messages::cam own;             ///< Its motion as its CAMs tell it.
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
    sofof::messages::payload_name<sofof::world::trajectory> = "trajectory";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::planners::plan_report> = "plan_report";
