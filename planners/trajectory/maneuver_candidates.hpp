// The ways to get past the others: before or after each who crosses, left or
// right of what stands in the lane.
#pragma once

#include "planners/path/path_planner.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/speed/speed_constraints.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sofof::planners {

/// What was decided last about those who cross, by the numbers of their bodies.
struct crossing_choice {
  static constexpr std::size_t most_cars = 4;

  bool waits = false;
  /// Those that the car goes before; 0: nobody.
  std::array<std::uint32_t, most_cars> before{};

  bool goes_before(std::uint32_t body) const {
    return body > 0 && std::ranges::find(before, body) != before.end();
  }
};

/// In which order to cross with the others, or to wait for all of them. One
/// decision is made for each of them, whatever number of places it crosses at.
struct crossing_order {
  static constexpr std::size_t most_cars = crossing_choice::most_cars;
  static constexpr std::size_t most_windows = 16;
  static constexpr std::uint32_t waits = 1U << most_cars;

  /// Bit i: before the i-th car, in the order in which they come; `waits`:
  /// before the first crossing.
  std::uint32_t choice = 0;
  std::array<std::uint32_t, most_cars> cars{}; ///< Their bodies, by bit.
  std::array<speed_constraints::window, most_windows> windows;
  std::size_t count = 0;
  double stop_m = speed_constraints::never; ///< Way to where it waits.
};

/// @returns the decision that an order is.
crossing_choice choice_of(const crossing_order& order);

/// The own car at the crossings.
struct crossing_car {
  double front_m = 0, rear_m = 0; ///< Rear axle to the bumpers.
  double speed_mps = 0;
  double top_mps = 0; ///< It will not drive faster.
  double max_accel_mps2 = 0;
  double firm_decel_mps2 = 2.5;
  double accel_mps2 = 0;
  bool is_impatient = false; ///< As in `driving_scene`.
};

/// @returns when the car has come so far, at the soonest, s.
double soonest_s(double way_m, const crossing_car& car);

/// @returns the way on which it can come to rest, braking firmly, m.
double stopping_m(const crossing_car& car);

/// @returns what was decided last, and that the car goes on before those before
///          whom it does by the plan in use and cannot stop any more: they have
///          just come in sight, or the plan was made elsewhere. So it does
///          before those who have to brake little, where it would have to brake
///          hard or is on all places well before them.
/// @param when_s  When the plan has made a way from the car on; infinite: it
///                does not.
crossing_choice going_on(crossing_choice last,
                         std::span<const crossing_user> users,
                         const crossing_car& car,
                         const std::function<double(double)>& way,
                         const std::function<double(double)>& when_s);

/// Lists the orders that are possible at all, and to wait, which always is.
/// First comes what was decided last, if it still is possible; then after all,
/// before all, and others, at most `most`, but those three in any case.
/// Without anybody to mind there is one, free of windows. Who goes before
/// another leaves it 1.5 s; 0.8 s once it has begun to, and 0.5 s where it
/// could not stop any more. Who has to wait where it cannot stop softly any
/// more stops up to 0.5 m beyond the line.
/// @param users  Times from now on.
/// @param way    From arc length on the route to way from the car on.
/// @param out    Reused.
/// @returns whether the first one is what was decided last.
bool list_orders(std::span<const crossing_user> users, const crossing_car& car,
                 const std::function<double(double)>& way,
                 const crossing_choice& last, std::size_t most,
                 std::vector<crossing_order>& out);

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
