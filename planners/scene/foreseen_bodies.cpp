// Where the bodies that a vehicle sees will be on its own way, and whether it
// would touch them.
#include "planners/scene/foreseen_bodies.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {

namespace {

constexpr auto no_limit = std::numeric_limits<double>::infinity();

/// A body's place along the way is looked for so far before and behind the
/// place that it would have if the way were straight.
constexpr auto foot_within_m = 20.0;

/// @returns whether a body is so far behind the car that no part of the way
/// where its place is looked for reaches the car's rear.
bool is_far_behind(const world::perceived_object& x, double guess_m,
                   double rear_m) {
  return guess_m + foot_within_m + (x.length_m + x.width_m) / 2 < rear_m;
}

} // namespace

void foreseen_bodies::look(const world::route& way, double s_m,
                           std::span<const world::perceived_object> seen,
                           const world::vehicle_params& car) {
  assert(std::isfinite(s_m));
  assert(car.width_m > 0 && car.front_m > -car.rear_m);
  boxes_.clear();
  front_m_ = s_m + car.front_m;
  rear_m_ = s_m - car.rear_m;
  half_corridor_m_ = car.width_m / 2;
  const auto& path = way.path();
  const auto here = path.frame(s_m);
  for (const auto& o : seen) {
    const auto to = o.centre - here.at;
    if (dot(to, to) > farthest_m * farthest_m)
      continue;
    const auto guess_m = s_m + dot(to, here.tangent);
    if (is_far_behind(o, guess_m, rear_m_))
      continue;
    const auto foot = path.project(o.centre, guess_m, foot_within_m);
    if (std::abs(foot.d_m) > farthest_beside_m
        || std::abs(foot.beyond_m) > farthest_beside_m)
      continue;
    const auto lane = path.frame(foot.s_m);
    const point axis{std::cos(o.heading_rad), std::sin(o.heading_rad)};
    const auto c = dot(lane.tangent, axis), s = cross(lane.tangent, axis);
    box x{foot.s_m + foot.beyond_m,
          foot.d_m,
          (std::abs(c) * o.length_m + std::abs(s) * o.width_m) / 2,
          (std::abs(s) * o.length_m + std::abs(c) * o.width_m) / 2
              - uncertain_m,
          o.speed_mps * c,
          o.speed_mps * s,
          0,
          no_limit,
          true,
          false};
    if (x.s_m + x.half_length_m < s_m - car.rear_m)
      continue;
    if (std::abs(c) > along_cosine) {
      // It keeps to its lane; its body has the lane's direction.
      x.across_mps = 0;
      x.half_width_m = o.width_m / 2 - uncertain_m;
      if (c > 0 && o.accel_mps2 < -least_braking_mps2)
        x.brakes_mps2 = -o.accel_mps2;
    } else {
      const auto apart_m = std::abs(x.d_m) - x.half_width_m - half_corridor_m_;
      const auto comes = x.d_m * x.across_mps < 0;
      const auto way_to_stop_m =
          x.across_mps * x.across_mps / (2 * expected_decel_mps2);
      x.counts = apart_m <= 0 || (comes && apart_m < way_to_stop_m);
      x.core_m = std::min(o.length_m, o.width_m) / 2 - uncertain_m;
      x.crosses = true;
    }
    assert(x.brakes_mps2 >= 0 && (x.crosses || x.counts));
    boxes_.push_back(x);
  }
}

double foreseen_bodies::along_m(const box& x, double t_s) {
  if (x.brakes_mps2 <= 0)
    return x.s_m + x.along_mps * t_s;
  const auto t = std::min(t_s, x.along_mps / x.brakes_mps2);
  return x.s_m + t * (x.along_mps - 0.5 * x.brakes_mps2 * t);
}

bool foreseen_bodies::any_in_reach(double ahead_m, double beside_m,
                                   double until_s) const {
  assert(beside_m >= 0 && until_s >= 0);
  assert(rear_m_ <= front_m_);
  return std::ranges::any_of(boxes_, [&](const box& x) {
    const auto moves_m = std::abs(x.along_mps) * until_s;
    const auto comes_m = std::abs(x.across_mps) * until_s;
    return x.counts && x.s_m - x.half_length_m - moves_m < front_m_ + ahead_m
           && x.s_m + x.half_length_m + moves_m > rear_m_
           && std::abs(x.d_m) - x.half_width_m - comes_m
                  < beside_m + half_corridor_m_;
  });
}

/// The own body may be turned: only the part of it counts that is beside the
/// other one.
bool foreseen_bodies::touches(const box& x, const place_in_time& p,
                              const world::vehicle_params& car,
                              double kept_gap_m) const {
  const auto half_m = std::min(x.half_length_m, x.core_m);
  const auto way_m = along_m(x, p.t_s) - p.s_m; // from the own axle
  const auto keeps_gap = kept_gap_m > 0 && p.speed_mps < creeps_mps
                         && !x.crosses && x.along_mps >= 0
                         && way_m - half_m > car.front_m;
  const auto front_m = car.front_m + (keeps_gap ? kept_gap_m : 0);
  const auto from_m = std::max(way_m - half_m, -car.rear_m);
  const auto to_m = std::min(way_m + half_m, front_m);
  if (from_m >= to_m)
    return false;
  assert(std::abs(p.turned) <= 1);
  const auto apart_m = x.d_m + x.across_mps * p.t_s - p.d_m;
  const auto near_m = apart_m - from_m * p.turned;
  const auto far_m = apart_m - to_m * p.turned;
  const auto least_m =
      near_m * far_m <= 0 ? 0.0 : std::min(std::abs(near_m), std::abs(far_m));
  const auto beside_m = half_corridor_m_ + std::min(x.half_width_m, x.core_m);
  return least_m < beside_m - (keeps_gap ? grazes_m : 0);
}

std::optional<foreseen_bodies::touch>
foreseen_bodies::first_touch(std::span<const place_in_time> motion,
                             const world::vehicle_params& car,
                             double kept_gap_m) const {
  assert(std::ranges::is_sorted(motion, {}, &place_in_time::t_s));
  assert(half_corridor_m_ >= 0);
  for (const auto& p : motion) {
    if (p.speed_mps < rests_mps)
      continue;
    const auto stands = p.speed_mps < stands_mps;
    for (const auto& x : boxes_)
      if (x.counts && !(x.crosses && stands) && touches(x, p, car, kept_gap_m))
        return touch{p.t_s, x.crosses};
  }
  return std::nullopt;
}

bool foreseen_bodies::any_ahead(double within_m) const {
  assert(within_m >= 0);
  assert(rear_m_ <= front_m_);
  return std::ranges::any_of(boxes_, [&](const box& x) {
    if (x.s_m + x.half_length_m < front_m_
        || x.s_m - x.half_length_m > front_m_ + within_m)
      return false;
    const auto apart_m = std::abs(x.d_m) - x.half_width_m - half_corridor_m_;
    const auto comes = x.d_m * x.across_mps < 0;
    return apart_m < near_beside_m
           || (comes && apart_m < soon_s * std::abs(x.across_mps));
  });
}

bool foreseen_bodies::any_near(double within_m, double beside_m) const {
  assert(within_m >= 0 && beside_m >= 0);
  assert(rear_m_ <= front_m_);
  return std::ranges::any_of(boxes_, [&](const box& x) {
    return x.s_m + x.half_length_m >= front_m_
           && x.s_m - x.half_length_m <= front_m_ + within_m
           && std::abs(x.d_m) - x.half_width_m <= beside_m;
  });
}

} // namespace sofof::planners
