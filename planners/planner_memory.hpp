// What a planner needs to go on from another one's plan.
#pragma once

#include "planners/path_ocp.hpp"
#include "planners/velocity_ocp.hpp"

#include <cmath>
#include <cstdint>

namespace sofof {

/// Plans and multipliers of both problems, where they begin, and what was
/// chosen. Plain numbers; may come from a stranger.
struct planner_memory {
  double path_s_m = 0; ///< First knot of the path problem, on the route.
  path_warm_start path;
  double speed_s_m = 0; ///< Of the velocity problem, likewise.
  bool stops = false;   ///< It ends at rest.
  velocity_warm_start speed;
  std::uint32_t sides = 0, order = 0; ///< As in planners/homotopy.hpp.
};

/// @returns whether both plans have a place on the route. What else is wrong
/// with a stranger's plans their solvers notice.
inline bool is_sound(const planner_memory& memory) {
  return std::isfinite(memory.path_s_m) && std::isfinite(memory.speed_s_m);
}

} // namespace sofof
