// Bodies as boxes along the way, and what each of them asks for.
#include "planners/safety/safe_response.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace sofof::planners {

namespace {

/// cos 37°: a body at a smaller angle to the way drives along it, or against
/// it.
constexpr auto along_cosine = 0.8;
/// A body's place on the way is looked for so far round its place if the way
/// were straight.
constexpr auto foot_near_m = 20.0;
constexpr auto unlimited = std::numeric_limits<double>::infinity();

/// How far the own body reaches to either side of its rear axle.
struct own_sides {
  double left_m, right_m;
};

own_sides sides_of(const safety_scene& x, const world::vehicle_params& car) {
  const auto sine = std::sin(x.turned_rad), cosine = std::cos(x.turned_rad);
  const auto half_m = car.width_m / 2 * cosine;
  // In a bend its straight body leaves the lane's middle to the outside.
  const auto bend = x.way.path().curvature_1pm(x.s_m);
  const auto out_m = car.front_m * car.front_m * std::abs(bend) / 2;
  return {std::max(car.front_m * sine, -car.rear_m * sine) + half_m
              + (bend < 0 ? out_m : 0),
          std::max(-car.front_m * sine, car.rear_m * sine) + half_m
              + (bend > 0 ? out_m : 0)};
}

/// A body as seen from the way.
struct seen_body {
  double ahead_m;     // from front bumper to it; negative: beside, or behind
  double behind_m;    // from it to the rear bumper; negative: beside, or ahead
  double beside_m;    // between the bodies, across; negative: in the own lane
  double along_mps;   // as the way leads
  double nearing_mps; // across, towards the own vehicle
  double own_nearing_mps; // and the own one towards it
  double speed_mps;
  double room_m;    // as it points, to the own lane; infinite if it points away
  bool is_along;    // or against it
  bool points_back; // against the way
};

class scene_view {
public:
  scene_view(const safety_scene& x, const world::vehicle_params& car)
      : x_{x}, car_{car}, here_{x.way.path().frame(x.s_m)}, sides_{sides_of(
                                                                x, car)} {}

  double along_mps() const { return x_.speed_mps * std::cos(x_.turned_rad); }
  double front_m() const { return x_.s_m + car_.front_m; }

  std::optional<seen_body> at(const world::perceived_object& o,
                              double farthest_m) const {
    const auto to = o.centre - here_.at;
    if (dot(to, to) > farthest_m * farthest_m)
      return std::nullopt;
    const auto& path = x_.way.path();
    const auto guess_m = x_.s_m + dot(to, here_.tangent);
    const auto foot = path.project(o.centre, guess_m, foot_near_m);
    const auto lane = path.frame(foot.s_m);
    const point axis{std::cos(o.heading_rad), std::sin(o.heading_rad)};
    const auto c = dot(lane.tangent, axis), s = cross(lane.tangent, axis);
    const auto half_length_m =
        (std::abs(c) * o.length_m + std::abs(s) * o.width_m) / 2;
    const auto half_width_m =
        (std::abs(s) * o.length_m + std::abs(c) * o.width_m) / 2;
    const auto s_m = foot.s_m + foot.beyond_m;
    const auto left_m = foot.d_m - x_.d_m;
    const auto side = left_m > 0 ? 1.0 : -1.0;
    const auto beside_m = std::abs(left_m) - half_width_m
                          - (left_m > 0 ? sides_.left_m : sides_.right_m);
    return seen_body{
        .ahead_m = s_m - half_length_m - front_m(),
        .behind_m = x_.s_m - car_.rear_m - s_m - half_length_m,
        .beside_m = beside_m,
        .along_mps = o.speed_mps * c,
        .nearing_mps = -side * o.speed_mps * s,
        .own_nearing_mps = side * x_.speed_mps * std::sin(x_.turned_rad),
        .speed_mps = o.speed_mps,
        .room_m =
            side * s < 0 ? std::max(0.0, beside_m) / std::abs(s) : unlimited,
        .is_along = std::abs(c) > along_cosine,
        .points_back = c < 0};
  }

private:
  const safety_scene& x_;
  const world::vehicle_params& car_;
  world::path_frame here_;
  own_sides sides_;
};

/// Who drives along the way, or against it.
safe_response beside_or_along(const seen_body& o, double own_mps,
                              const rss_assumptions& assumed) {
  const auto across_s =
      meets_safely_s({o.beside_m, o.own_nearing_mps, o.nearing_mps},
                     assumed.lat, assumed.others_response_s);
  if (o.points_back) {
    const auto along_s =
        meets_safely_s({o.ahead_m, own_mps, std::max(0.0, -o.along_mps)},
                       assumed.lon, assumed.others_response_s);
    return {std::max(across_s, along_s), "oncoming"};
  }
  const auto along_s = follows_safely_s(
      {o.ahead_m, own_mps, std::max(0.0, o.along_mps)}, assumed.lon);
  return {std::max(across_s, along_s), "follow"};
}

/// Who stands across the lane, or comes from the side.
safe_response crossing(const seen_body& o, double own_mps, bool has_priority,
                       const rss_assumptions& assumed) {
  const auto stop_s = longest_response_s(own_mps, o.ahead_m, assumed.lon);
  if (o.beside_m <= 0) // whoever has priority
    return {stop_s, "crossing"};
  const auto stops_m =
      farthest_m(o.speed_mps, assumed.others_response_s, assumed.lon);
  if (!has_priority && stops_m > o.room_m)
    return {stop_s, "crossing"};
  // It stops so near, or has to stay where it is.
  const auto left_m =
      has_priority ? o.beside_m : o.beside_m * (1 - stops_m / o.room_m);
  const auto across_s =
      longest_response_s(o.own_nearing_mps, left_m, assumed.lat);
  return {std::max(stop_s, across_s), "crossing"};
}

} // namespace

safe_response longest_safe_response(const safety_scene& x,
                                    const rss_assumptions& assumed,
                                    const world::vehicle_params& car,
                                    double most_s) {
  assert(std::isfinite(x.s_m) && x.speed_mps >= 0 && most_s > 0);
  safe_response least{most_s, "free"};
  const auto take = [&](const safe_response& one) {
    if (one.longest_s < least.longest_s)
      least = {std::max(0.0, one.longest_s), one.because};
  };
  const scene_view from{x, car};
  const auto own_mps = from.along_mps();
  if (x.stop_at_m)
    take({longest_response_s(own_mps, *x.stop_at_m - from.front_m(),
                             assumed.lon),
          "line"});
  for (const auto& o : x.objects) {
    // Farther away nobody matters, if both come as fast as they can.
    const auto farthest =
        20 + farthest_m(own_mps, most_s, assumed.lon)
        + farthest_m(o.speed_mps, assumed.others_response_s, assumed.lon);
    const auto body = from.at(o, farthest);
    if (!body || body->behind_m > 0)
      continue;
    take(body->is_along ? beside_or_along(*body, own_mps, assumed)
                        : crossing(*body, own_mps, x.has_priority, assumed));
  }
  assert(least.longest_s >= 0 && least.longest_s <= most_s);
  return least;
}

} // namespace sofof::planners
