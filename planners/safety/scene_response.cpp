// Lead, bodies beside and who crosses, and what each of them asks for.
#include "planners/safety/scene_response.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

/// The own body's sides, left of the lane's middle.
struct own_width {
  double right_m, left_m;
};

own_width width_of(const scene_viewer& me, const world::vehicle_params& car) {
  assert(std::isfinite(me.d_m) && std::isfinite(me.turned_rad));
  assert(std::isfinite(me.curvature_1pm));
  const auto sine = std::sin(me.turned_rad);
  const auto half_m = car.width_m / 2 * std::abs(std::cos(me.turned_rad));
  const auto front_m = car.front_m * sine, rear_m = -car.rear_m * sine;
  // In a bend its straight body leaves the lane's middle to the outside.
  const auto bend = me.curvature_1pm;
  const auto out_m = car.front_m * car.front_m * std::abs(bend) / 2;
  return {me.d_m + std::min(front_m, rear_m) - half_m - (bend > 0 ? out_m : 0),
          me.d_m + std::max(front_m, rear_m) + half_m + (bend < 0 ? out_m : 0)};
}

safe_response beside(const lane_obstacle& o, const scene_viewer& me,
                     const own_width& own, double front_m,
                     const rss_assumptions& assumed) {
  assert(std::isfinite(front_m));
  assert(own.right_m <= own.left_m);
  const auto is_left = o.low_m + o.high_m > own.right_m + own.left_m;
  const auto gap_m = is_left ? o.low_m - own.left_m : own.right_m - o.high_m;
  const auto nearing_mps =
      (is_left ? 1 : -1) * me.speed_mps * std::sin(me.turned_rad);
  const auto across_s = meets_safely_s({gap_m, nearing_mps, 0}, assumed.lat,
                                       assumed.others_response_s);
  const rss_gap along{o.from_m - front_m, me.speed_mps, std::abs(o.speed_mps)};
  if (o.speed_mps < 0)
    return {std::max(across_s, meets_safely_s(along, assumed.lon,
                                              assumed.others_response_s)),
            "oncoming"};
  return {std::max(across_s, follows_safely_s(along, assumed.lon)), "follow"};
}

} // namespace

safe_response longest_safe_response(const driving_scene& told,
                                    const scene_viewer& me,
                                    const rss_assumptions& assumed,
                                    const world::vehicle_params& car,
                                    double most_s) {
  assert(std::isfinite(me.s_m) && me.speed_mps >= 0);
  assert(most_s > 0);
  safe_response least{most_s, "free"};
  const auto take = [&](const safe_response& one) {
    if (one.longest_s < least.longest_s)
      least = {std::max(0.0, one.longest_s), one.because};
  };
  const auto front_m = me.s_m + car.front_m;
  if (told.lead)
    take({follows_safely_s({told.lead->rear_s_m - front_m, me.speed_mps,
                            std::max(0.0, told.lead->speed_mps)},
                           assumed.lon),
          "follow"});
  const auto own = width_of(me, car);
  for (const auto& o : told.beside)
    if (o.to_m > me.s_m - car.rear_m)
      take(beside(o, me, own, front_m, assumed));
  for (const auto& c : told.crossings) {
    const auto comes_first = c.goes_first && !me.has_priority
                             && c.brakes_mps2 > assumed.lon.brake_min_mps2;
    if (c.leave_s > 0 && c.from_m > front_m && (c.enter_s <= 0 || comes_first))
      take({longest_response_s(me.speed_mps, c.from_m - front_m, assumed.lon),
            "crossing"});
  }
  assert(least.longest_s >= 0 && least.longest_s <= most_s);
  return least;
}

} // namespace sofof::planners
