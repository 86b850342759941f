// What a car's body sweeps whose rear axle follows a line.
#include "maps/swept_body.hpp"

#include "world/roads/path.hpp"
#include "world/vehicle/vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::maps {

double needed_half_width_m(const std::vector<point>& centre) {
  constexpr auto beside_m = 0.4, step_m = 0.5;
  const world::vehicle_params car;
  const world::path line{centre};
  auto widest_m = 0.0;
  for (auto s_m = 0.0; s_m < line.length_m() - car.wheelbase_m; s_m += step_m) {
    const auto rear = line.at(s_m);
    const point ahead{std::cos(rear.heading_rad), std::sin(rear.heading_rad)};
    const auto front = rear.at + car.wheelbase_m * ahead;
    const auto seen = line.project(front, s_m + car.wheelbase_m);
    widest_m = std::max(widest_m, std::abs(seen.d_m));
  }
  return widest_m + car.width_m / 2 + beside_m;
}

} // namespace sofof::maps
