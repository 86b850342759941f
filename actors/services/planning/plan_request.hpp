// What a vehicle and the planner in it say to each other.
#pragma once

#include "messages/protocol/payload.hpp"
#include "messages/protocol/service.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/trajectory.hpp"

#include <string>
#include <vector>

namespace sofof {

/// Please plan along this route from this state.
struct plan_request {
  std::string way;     ///< Name of the route.
  planning_input from; ///< What it knows of others stays here.
  perception seen;     ///< By the vehicle, and granted to it.
  cam own;             ///< Its motion as its CAMs tell it.
};

template <>
inline constexpr std::string_view payload_name<plan_request> = "plan_request";
template <>
inline constexpr std::string_view payload_name<trajectory> = "trajectory";
template <>
inline constexpr std::string_view payload_name<plan_report> = "plan_report";

void archive(auto& bytes, perceived_object& x) {
  bytes(x.centre, x.heading_rad, x.speed_mps, x.accel_mps2, x.length_m,
        x.width_m);
}

void archive(auto& bytes, perception& x) {
  bytes(x.at, x.stop_at_m, x.objects);
}

void archive(auto& bytes, planning_input& x) {
  bytes(x.at, x.s_m, x.d_m, x.heading_error_rad, x.curvature_1pm, x.speed_mps,
        x.accel_mps2);
}

void archive(auto& bytes, point& x) {
  bytes(x.x_m, x.y_m);
}

void archive(auto& bytes, cam& x) {
  bytes(x.station, x.at, x.position, x.heading_rad, x.speed_mps, x.accel_mps2,
        x.curvature_1pm, x.length_m, x.width_m);
}

void archive(auto& bytes, plan_request& x) {
  bytes(x.way, x.from, x.seen, x.own);
}

void archive(auto& bytes, trajectory_point& x) {
  bytes(x.t_s, x.s_m, x.at, x.heading_rad, x.curvature_1pm, x.speed_mps,
        x.accel_mps2);
}

void archive(auto& bytes, trajectory& x) {
  bytes(x.start, x.points);
}

void archive(auto& bytes, motion_extremes& x) {
  bytes(x.lateral_accel_mps2, x.jerk_mps3, x.min_accel_mps2);
}

void archive(auto& bytes, plan_report& x) {
  bytes(x.origin, x.path, x.velocity, x.emergency, x.violation, x.iterations,
        x.candidates, x.choice, x.dwell_s, x.input, x.extremes);
}

} // namespace sofof
