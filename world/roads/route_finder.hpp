// Which of the known routes somebody follows who only tells its waypoints.
#pragma once

#include "world/roads/route.hpp"

#include <optional>
#include <span>

namespace sofof::world {

/// From the first to the last of some waypoints, as arc lengths on a route.
struct route_stretch {
  double from_m = 0;
  double to_m = 0; ///< >= from_m; on a closed route possibly in the next lap.
};

/// A known route, and where on it somebody's waypoints are.
struct found_route {
  route_ptr way;
  route_stretch ahead;
};

/// Finds the route that runs through all waypoints, in their order and within
/// 0.5 m of each, and is as long between any two neighbours as they are apart,
/// but for its bends. Of several the first one, those within 0.1 m before the
/// others: routes may be alike as far as the waypoints go.
/// @param routes     Not null.
/// @param waypoints  In driving order, m, some 5 to 20 m apart; in tight bends
///                   not more than half a circle.
/// @returns nothing for fewer than two waypoints, less than a metre of way,
/// what is not a number, or where no route fits; else with `from_m` on the
/// first lap.
std::optional<found_route> find_route(std::span<const route_ptr> routes,
                                      std::span<const point> waypoints);

/// Asks the same of one route, cheaply.
/// @param s_guess_m  About where the first waypoint is, within 20 m; laps
///                   count, and the result counts them alike.
std::optional<route_stretch> still_on(const route& way, double s_guess_m,
                                      std::span<const point> waypoints);

} // namespace sofof::world
