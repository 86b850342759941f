// Whether a vehicle may appear on the road without surprising anybody.
#include "world/traffic/spawn_clearance.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::world {

namespace {

constexpr auto standing_m = 12.0;
constexpr auto reaction_s = 1.0;
constexpr auto decel_mps2 = 2.0;

double way_to_stop_m(double speed_mps) {
  return speed_mps * reaction_s + speed_mps * speed_mps / (2 * decel_mps2);
}

} // namespace

bool is_free(const oriented_box& place, double speed_mps,
             std::span<const road_body> others) {
  assert(speed_mps >= 0);
  return std::ranges::all_of(others, [&](const road_body& other) {
    const auto faster_mps = std::max(speed_mps, other.speed_mps);
    return distance_m(place.centre, other.box.centre)
           > standing_m + way_to_stop_m(faster_mps);
  });
}

} // namespace sofof::world
