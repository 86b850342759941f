// Motion along a lane and beside its centre line (Frenet frame).
#include "planners/scene/lane_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::planners {
namespace {

// Critically damped decay: 4 constants long leave 9 % of the offset.
constexpr double decay_constants = 4;
// Steering back takes at least this long, which bounds lateral acceleration.
constexpr double min_centring_s = 3;
constexpr double negligible = 1e-3; // m, rad
constexpr double max_heading_error_rad = 0.8;
constexpr double min_stretch = 0.2;

} // namespace

lane_motion advance(const lane_motion& x, double accel_mps2, double dt_s) {
  assert(dt_s >= 0);
  const auto mean = 0.5 * (x.accel_mps2 + accel_mps2);
  const auto speed = x.speed_mps + mean * dt_s;
  if (speed > 0)
    return {
        x.s_m
            + dt_s * (x.speed_mps + dt_s * (2 * x.accel_mps2 + accel_mps2) / 6),
        speed, accel_mps2};
  const auto way = mean < 0 ? x.speed_mps * x.speed_mps / (-2 * mean) : 0;
  assert(!(way < 0)); // to rest, and not back
  return {x.s_m + way, 0, 0};
}

planning_input moved_forward(planning_input x, time_point now) {
  const auto dt_s = to_seconds(now - x.at);
  if (dt_s <= 0)
    return x;
  const auto then =
      advance({x.s_m, x.speed_mps, x.accel_mps2}, x.accel_mps2, dt_s);
  assert(!(then.speed_mps < 0));
  assert(x.speed_mps < 0 || !(then.s_m < x.s_m));
  x.d_m += (then.s_m - x.s_m) * std::sin(x.heading_error_rad);
  x.at = now;
  x.s_m = then.s_m;
  x.speed_mps = then.speed_mps;
  x.accel_mps2 = then.accel_mps2;
  return x;
}

planning_input seen_from(const world::route& way,
                         const world::trajectory_point& p) {
  assert(std::isfinite(p.s_m));
  const auto centre = way.path().at(p.s_m);
  const point tangent{std::cos(centre.heading_rad),
                      std::sin(centre.heading_rad)};
  planning_input x;
  x.s_m = p.s_m;
  x.d_m = cross(tangent, p.at - centre.at);
  x.heading_error_rad = wrap_angle(p.heading_rad - centre.heading_rad);
  assert(!(std::abs(x.heading_error_rad) > std::numbers::pi));
  x.curvature_1pm = p.curvature_1pm;
  x.speed_mps = p.speed_mps;
  x.accel_mps2 = p.accel_mps2;
  return x;
}

centring::centring(const world::route& way, const planning_input& x,
                   double length_m)
    : way_{way} {
  assert(length_m > 0);
  assert(std::isfinite(x.s_m) && x.speed_mps >= 0);
  const auto length = std::max(length_m, min_centring_s * x.speed_mps);
  rate_1pm_ = decay_constants / length;
  offset_m_ = x.d_m;
  const auto turned = std::clamp(x.heading_error_rad, -max_heading_error_rad,
                                 max_heading_error_rad);
  const auto bend = way.path().at(x.s_m).curvature_1pm;
  const auto inner = std::max(min_stretch, 1 - bend * x.d_m);
  slope_ = std::tan(turned) * inner;
  const auto shrink = std::cos(turned) / inner;
  assert(shrink > 0); // it drives along the lane, however it is turned
  const auto stands = x.speed_mps <= 0;
  motion_ = {x.s_m, shrink * x.speed_mps,
             shrink * (stands ? std::max(0.0, x.accel_mps2) : x.accel_mps2)};
}

world::trajectory_point centring::place(const lane_motion& x,
                                        double t_s) const {
  assert(t_s >= 0 && rate_1pm_ > 0);
  const auto centre = way_.path().at(x.s_m);
  world::trajectory_point p{t_s,
                            x.s_m,
                            centre.at,
                            centre.heading_rad,
                            centre.curvature_1pm,
                            x.speed_mps,
                            x.accel_mps2};
  if (std::abs(offset_m_) < negligible && std::abs(slope_) < negligible)
    return p;

  const auto way_m = x.s_m - motion_.s_m;
  const auto decay = std::exp(-rate_1pm_ * way_m);
  const auto growth = slope_ + rate_1pm_ * offset_m_;
  const auto d = (offset_m_ + growth * way_m) * decay;
  const auto slope = growth * decay - rate_1pm_ * d;
  const auto bend = -rate_1pm_ * (2 * slope + rate_1pm_ * d);

  const auto inner = std::max(min_stretch, 1 - centre.curvature_1pm * d);
  const auto stretch = std::sqrt(inner * inner + slope * slope);
  const auto turned = std::atan(slope / inner);
  const auto cosine = inner / stretch;
  assert(!(cosine <= 0 || cosine > 1));
  p.at =
      centre.at
      + d * point{-std::sin(centre.heading_rad), std::cos(centre.heading_rad)};
  p.heading_rad += turned;
  p.curvature_1pm = (bend + centre.curvature_1pm * slope * slope / inner)
                        * cosine * cosine * cosine / (inner * inner)
                    + centre.curvature_1pm * cosine / inner;
  p.speed_mps *= stretch;
  p.accel_mps2 *= stretch;
  return p;
}

} // namespace sofof::planners
