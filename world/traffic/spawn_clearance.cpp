// Whether a vehicle may appear on the road without surprising anybody.
#include "world/traffic/spawn_clearance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {

namespace {

constexpr auto standing_m = 12.0;
constexpr auto reaction_s = 1.0;
constexpr auto decel_mps2 = 2.0;

double way_to_stop_m(double speed_mps) {
  return speed_mps * reaction_s + speed_mps * speed_mps / (2 * decel_mps2);
}

// Whether a point lies behind a body, by 60 degrees to either side.
bool leaves(const oriented_box& body, point behind) {
  constexpr auto cos_60 = 0.5;
  const point ahead{std::cos(body.heading_rad), std::sin(body.heading_rad)};
  const auto back = behind - body.centre;
  return dot(ahead, back) < -cos_60 * distance_m(body.centre, behind);
}

} // namespace

bool is_free(const oriented_box& place, double speed_mps,
             std::span<const road_body> others) {
  assert(speed_mps >= 0);
  return std::ranges::all_of(others, [&](const road_body& other) {
    const auto own_mps = leaves(place, other.box.centre) ? 0 : speed_mps;
    const auto other_mps =
        leaves(other.box, place.centre) ? 0 : other.speed_mps;
    return distance_m(place.centre, other.box.centre)
           > standing_m + way_to_stop_m(std::max(own_mps, other_mps));
  });
}

} // namespace sofof::world
