// What vehicles and trajectory planners say to each other.
#pragma once

#include "messages/payload.hpp"
#include "planners/trajectory_planner.hpp"
#include "world/perception.hpp"
#include "world/trajectory.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sofof {

/// Please plan along this route from this state.
struct plan_request {
  std::string way;     ///< Name of the route; both sides have the map.
  planning_input from; ///< What it knows of others stays here.
  perception seen;     ///< By the vehicle, and granted to it.
};

/// A plan, how it came about, and what it takes to go on from it elsewhere.
struct drive_plan {
  trajectory plan;
  plan_report report;
  std::shared_ptr<const planner_memory> memory; ///< Null: nothing.
};

template <>
inline constexpr std::string_view payload_name<plan_request> = "plan_request";
template <>
inline constexpr std::string_view payload_name<drive_plan> = "drive_plan";

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

void archive(auto& bytes, plan_request& x) {
  bytes(x.way, x.from, x.seen);
}

void archive(auto& bytes, point& x) {
  bytes(x.x_m, x.y_m);
}

void archive(auto& bytes, trajectory_point& x) {
  bytes(x.t_s, x.s_m, x.at, x.heading_rad, x.curvature_1pm, x.speed_mps,
        x.accel_mps2);
}

void archive(auto& bytes, trajectory& x) {
  bytes(x.start, x.points);
}

void archive(auto& bytes, plan_report& x) {
  bytes(x.origin, x.path, x.velocity, x.emergency, x.violation, x.iterations,
        x.candidates, x.choice, x.dwell_s, x.input);
}

/// A multiplier that is not 0; most are.
struct active_bound {
  std::uint16_t knot = 0;
  float force = 0;
};

void archive(auto& bytes, active_bound& x) {
  bytes(x.knot, x.force);
}

template <std::size_t rows>
void archive(auto& bytes, ocp::warm_start<rows>& x) {
  bytes(x.ds_m, x.steps);
  const auto knots = std::clamp(x.steps, 0, ocp::most_steps) + 1;
  for (auto* column : {&x.x0, &x.x1, &x.x2, &x.u})
    for (int k = 0; k < knots; ++k)
      bytes((*column)[static_cast<std::size_t>(k)]);
  for (auto& force : x.force) {
    std::vector<active_bound> active;
    for (std::uint16_t k = 0; k < knots; ++k)
      if (force[k] != 0)
        active.push_back({k, force[k]});
    bytes(active);
    for (const auto& bound : active)
      if (bound.knot < force.size())
        force[bound.knot] = bound.force;
  }
}

void archive(auto& bytes, planner_memory& x) {
  bytes(x.path_s_m, x.path, x.speed_s_m, x.stops, x.speed, x.sides, x.order);
}

void archive(auto& bytes, drive_plan& x) {
  std::optional<planner_memory> memory;
  if (x.memory)
    memory = *x.memory;
  bytes(x.plan, x.report, memory);
  if (memory)
    x.memory = std::make_shared<const planner_memory>(*memory);
}

} // namespace sofof
