// Straight on at constant speed.
#include "planners/trajectory/keep_speed.hpp"

#include "planners/scene/lane_motion.hpp"

#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double sample_s = 0.1;
constexpr auto steps = 30;
constexpr double nothing_to_centre_m = 15.0;

} // namespace

world::trajectory keep_speed(const world::route& way, time_point now,
                             double s_m, double speed_mps) {
  assert(std::isfinite(s_m));
  assert(speed_mps >= 0);
  planning_input from;
  from.s_m = s_m;
  from.speed_mps = speed_mps;
  const centring line{way, from, nothing_to_centre_m};
  auto x = line.motion();
  world::trajectory plan{now, {}};
  for (auto i = 0; i <= steps; ++i) {
    plan.points.push_back(line.place(x, i * sample_s));
    x = advance(x, 0, sample_s);
  }
  return plan;
}

} // namespace sofof::planners
