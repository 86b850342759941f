// Straight on at constant speed.
#include "planners/keep_speed.hpp"

#include "planners/lane_motion.hpp"

namespace sofof {
namespace {

constexpr double step_s = 0.1;
constexpr auto steps = 30;
constexpr double centring_length_m = 15.0; // nothing to centre

} // namespace

trajectory keep_speed(const route& way, time_point now, double s_m,
                      double speed_mps) {
  planning_input from;
  from.s_m = s_m;
  from.speed_mps = speed_mps;
  const centring line{way, from, centring_length_m};
  auto x = line.motion();
  trajectory plan{now, {}};
  for (auto i = 0; i <= steps; ++i) {
    plan.points.push_back(line.place(x, i * step_s));
    x = advance(x, 0, step_s);
  }
  return plan;
}

} // namespace sofof
