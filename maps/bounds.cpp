// Lanes that are given by their left and right bounds.
#include "maps/bounds.hpp"

#include "maps/polyline.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::maps {

lane_middle middle_of(std::span<const point> left,
                      std::span<const point> right) {
  assert(left.size() >= 2);
  assert(right.size() >= 2);
  constexpr auto apart_m = 2.0, most = 5000.0;
  const auto left_m = length_m(left), right_m = length_m(right);
  const auto count =
      std::clamp(std::ceil(std::max(left_m, right_m) / apart_m), 2.0, most);
  lane_middle made;
  auto narrowest_m = std::numeric_limits<double>::infinity();
  line_walk along_left{left}, along_right{right};
  for (auto i = 0.0; i <= count; ++i) {
    const auto a = along_left.to(left_m * i / count);
    const auto b = along_right.to(right_m * i / count);
    made.centre.push_back(0.5 * (a + b));
    narrowest_m = std::min(narrowest_m, distance_m(a, b));
  }
  made.half_width_m = narrowest_m / 2;
  return made;
}

} // namespace sofof::maps
