// What no car can do is cut off an input.
#include "planners/scene/planning_input.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// What is beyond is no car's motion.
constexpr double longest_way_m = 1e7;
constexpr double widest_off_m = 5;
constexpr double most_turned_rad = 1;
constexpr double most_curvature_1pm = 1;
constexpr double fastest_mps = 100;
constexpr double most_accel_mps2 = 20;

} // namespace

planning_input made_possible(planning_input x) {
  const auto cut = [](double& number, double least, double most) {
    number = std::isnan(number) ? 0 : std::clamp(number, least, most);
    assert(number >= least && number <= most); // 0 has to be possible, too
  };
  cut(x.s_m, -longest_way_m, longest_way_m);
  cut(x.d_m, -widest_off_m, widest_off_m);
  cut(x.heading_error_rad, -most_turned_rad, most_turned_rad);
  cut(x.curvature_1pm, -most_curvature_1pm, most_curvature_1pm);
  cut(x.speed_mps, 0, fastest_mps);
  cut(x.accel_mps2, -most_accel_mps2, most_accel_mps2);
  return x;
}

} // namespace sofof::planners
