// The ways to get past the others: before or after each who crosses, left or
// right of what stands in the lane.
#pragma once

#include "planners/path/path_planner.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/speed/speed_constraints.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sofof::planners {

/// In which order to cross with the others, or to wait for all of them.
struct crossing_order {
  static constexpr std::size_t most_users = 4;
  static constexpr std::uint32_t waits = 1U << most_users;

  /// Bit i: before the i-th user; `waits`: before the first crossing.
  std::uint32_t choice = 0;
  std::array<speed_constraints::window, most_users> windows;
  std::size_t count = 0;
  double stop_m = speed_constraints::never; ///< Way to where it waits.
};

/// The own car at the crossings.
struct crossing_car {
  double front_m = 0, rear_m = 0; ///< Rear axle to the bumpers.
  double speed_mps = 0;
  double top_mps = 0; ///< It will not drive faster.
  double max_accel_mps2 = 0;
};

/// Lists the orders that are possible at all, at most `most`, and to wait,
/// which always is; `first`, if it still is one, comes first. Without anybody
/// to mind there is one, free of windows.
/// @param users  Times from now on.
/// @param way    From arc length on the route to way from the car on.
/// @param out    Reused.
void list_orders(std::span<const crossing_user> users, const crossing_car& car,
                 const std::function<double(double)>& way, std::uint32_t first,
                 std::size_t most, std::vector<crossing_order>& out);

/// More bodies than this are not passed at once.
inline constexpr std::size_t most_bodies = 4;

/// @returns whether the car fits between a body and the lane's edge.
bool leaves_room(const lane_obstacle& body, side_of_road side,
                 double half_width_m);

/// Sides to pass bodies on; bit i: right of the i-th.
struct passing_order {
  std::uint32_t choice = 0;
  std::vector<path_planner::passing> bodies;
};

/// Lists the combinations of sides that leave room, at most `most`; `first`
/// comes first if it is one.
/// @param half_width_m  Of the lane, m.
void list_sides(std::span<const lane_obstacle> bodies, double half_width_m,
                std::uint32_t first, std::size_t most,
                std::vector<passing_order>& out);

} // namespace sofof::planners
