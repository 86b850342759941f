// Time to pass what blocks a lane.
#include "planners/scene/overtaking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// How a car sets off to overtake.
constexpr double overtakes_mps2 = 1.2, thinks_s = 0.5;
/// To be left to who comes: to begin with, of who is not seen yet, having
/// begun.
constexpr double spare_s = 2.5, spare_of_unseen_s = 1.0, spare_begun_s = 1.0;
/// Who is not seen yet drives so much above the limit.
constexpr double speeding = 1.1;
constexpr double oncoming_stands_mps = 0.3;
/// The way is straight if it turns less than this, rad.
constexpr double straight_rad = 0.35;
constexpr double looked_at_every_m = 3;

bool is_two_way(const world::route& way, double from_m, double to_m) {
  assert(from_m <= to_m);
  const auto first_rad = way.path().at(from_m).heading_rad;
  for (auto s = from_m; s <= to_m; s += looked_at_every_m) {
    const auto on = way.closed() ? s : std::clamp(s, 0.0, way.length_m());
    const auto bounds = way.bounds_at(on);
    if (bounds.left_m <= bounds.half_width_m
        || std::abs(wrap_angle(way.path().at(on).heading_rad - first_rad))
               > straight_rad)
      return false;
  }
  assert(std::isfinite(first_rad));
  return way.closed() || (from_m >= 0 && to_m <= way.length_m());
}

/// @returns how long it takes to come so far.
double takes_s(double way_m, double speed_mps, double limit_mps) {
  assert(way_m >= 0 && speed_mps >= 0);
  assert(limit_mps > 0);
  const auto v = std::min(speed_mps, limit_mps);
  const auto until_top_m =
      (limit_mps * limit_mps - v * v) / (2 * overtakes_mps2);
  if (way_m < until_top_m)
    return thinks_s
           + (std::sqrt(v * v + 2 * overtakes_mps2 * way_m) - v)
                 / overtakes_mps2;
  return thinks_s + (limit_mps - v) / overtakes_mps2
         + (way_m - until_top_m) / limit_mps;
}

} // namespace

bool has_time_to_overtake(const world::route& way, const overtaking_car& car,
                          const blocked_stretch& body,
                          std::span<const oncoming_body> coming) {
  assert(body.from_m <= body.to_m && car.rear_m < car.front_m);
  assert(car.speed_mps >= 0);
  const auto begins_m = std::max(car.rear_m, body.from_m - leaves_before_m);
  const auto ends_m = body.to_m + is_back_after_m;
  if (!is_two_way(way, begins_m, ends_m))
    return false;
  const auto limit_mps = way.limit_mps(body.to_m);
  const auto own_s =
      takes_s(std::max(0.0, ends_m - car.rear_m), car.speed_mps, limit_mps);
  const auto leaves_time = [&](const oncoming_body& x) {
    assert(x.front_m <= x.rear_m && x.speed_mps >= 0);
    if (x.rear_m < begins_m)
      return true; // it has passed
    if (x.speed_mps < oncoming_stands_mps)
      return x.front_m > ends_m;
    return (x.front_m - ends_m) / x.speed_mps
           > own_s + (car.has_begun ? spare_begun_s : spare_s);
  };
  const auto unseen_s = (car.sees_to_m - ends_m) / (speeding * limit_mps);
  return std::ranges::all_of(coming, leaves_time)
         && (car.has_begun || unseen_s > own_s + spare_of_unseen_s);
}

} // namespace sofof::planners
