// Which of the known routes somebody follows who only tells its waypoints.
#include "world/roads/route_finder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {
namespace {

/// How far waypoints are from the line: of somebody with the same map, and of
/// somebody with another one. Lanes side by side are farther apart.
constexpr double exact_m = 0.1;
constexpr double tolerance_m = 0.5;

/// Waypoints beside the line, on either side of a bend, and rounded.
constexpr double least_stretch = 0.9;
constexpr double rounding_m = 0.1;

/// Half a circle is pi / 2 times as long as its chord.
constexpr double most_stretch = 1.6;

/// A shorter way has no direction to rely on.
constexpr double least_way_m = 1;

/// How far a guess may be off.
constexpr double window_m = 20;

/// Nothing on a map is farther away.
constexpr double farthest_m = 1e7;

bool is_way(std::span<const point> waypoints) {
  // Comparisons with NaN are false.
  return waypoints.size() >= 2 && std::ranges::all_of(waypoints, [](point p) {
           return std::abs(p.x_m) <= farthest_m
                  && std::abs(p.y_m) <= farthest_m;
         });
}

/// Where a point is on a path around a guess, if it is there.
std::optional<double> place(const path& line, point p, double s_guess_m,
                            double window_m, double tolerance_m) {
  const auto s_m = line.project(p, s_guess_m, window_m).s_m;
  if (distance_m(line.at(s_m).at, p) > tolerance_m)
    return std::nullopt;
  return s_m;
}

/// Goes from waypoint to waypoint along a path.
std::optional<route_stretch> walk(const path& line, double from_m,
                                  std::span<const point> waypoints,
                                  double tolerance_m) {
  auto s_m = from_m;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const auto chord_m = distance_m(waypoints[i - 1], waypoints[i]);
    const auto least_m = s_m + least_stretch * chord_m - rounding_m;
    const auto most_m = s_m + most_stretch * chord_m + rounding_m;
    const auto guess_m = s_m + chord_m; // mostly it is straight
    const auto next =
        place(line, waypoints[i], guess_m, most_m - guess_m, tolerance_m);
    if (!next || *next < least_m)
      return std::nullopt;
    s_m = *next;
  }
  if (s_m - from_m < least_way_m)
    return std::nullopt;
  return route_stretch{from_m, s_m};
}

/// Tries every place of a path that is within the tolerance of the first
/// waypoint, in order.
std::optional<route_stretch>
search(const path& line, std::span<const point> waypoints, double tolerance_m) {
  for (auto s_m = 0.0; s_m < line.length_m();) {
    // The distance changes by at most a metre a metre.
    const auto away_m = distance_m(line.at(s_m).at, waypoints.front());
    if (away_m > tolerance_m) {
      s_m += std::max(away_m - tolerance_m, tolerance_m / 2);
      continue;
    }
    if (const auto from_m =
            place(line, waypoints.front(), s_m, 2 * tolerance_m, tolerance_m))
      if (const auto found = walk(line, *from_m, waypoints, tolerance_m))
        return found;
    s_m += 4 * tolerance_m;
  }
  return std::nullopt;
}

} // namespace

std::optional<found_route> find_route(std::span<const route_ptr> routes,
                                      std::span<const point> waypoints) {
  assert(std::ranges::find(routes, nullptr) == routes.end());
  if (!is_way(waypoints))
    return std::nullopt;
  for (const auto near_m : {exact_m, tolerance_m})
    for (const auto& way : routes)
      if (auto ahead = search(way->path(), waypoints, near_m)) {
        if (way->closed()) { // a foot just before or after the seam
          const auto lap_m = way->length_m();
          const auto laps_m = lap_m * std::floor(ahead->from_m / lap_m);
          ahead->from_m -= laps_m;
          ahead->to_m -= laps_m;
        }
        return found_route{way, *ahead};
      }
  return std::nullopt;
}

std::optional<route_stretch> still_on(const route& way, double s_guess_m,
                                      std::span<const point> waypoints) {
  if (!is_way(waypoints) || !std::isfinite(s_guess_m))
    return std::nullopt;
  const auto from_m =
      place(way.path(), waypoints.front(), s_guess_m, window_m, tolerance_m);
  return from_m ? walk(way.path(), *from_m, waypoints, tolerance_m)
                : std::nullopt;
}

} // namespace sofof::world
