// Whether a car keeps to its road.
#include "world/traffic/on_road.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::world {
namespace {

constexpr double sought_within_m = 2;

} // namespace

bool is_on_road(const route& way, double s_m, const vehicle_state& car,
                const vehicle_params& params) {
  const auto half_m = params.width_m / 2;
  const point ahead{std::cos(car.heading_rad), std::sin(car.heading_rad)};
  const auto d_m = [&](point p, double at_m) {
    return way.path().project(p, at_m, sought_within_m).d_m;
  };
  const auto rear = d_m(car.at, s_m);
  const auto front =
      d_m(car.at + params.wheelbase_m * ahead, s_m + params.wheelbase_m);
  return way.bounds_at(s_m).hold(std::min(rear, front) - half_m,
                                 std::max(rear, front) + half_m);
}

} // namespace sofof::world
