// Bodies as boxes along the way, and what each of them asks for.
#include "planners/safety/safe_response.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace sofof::planners {

namespace {

/// cos 37°: who drives at a smaller angle to the way drives along it.
constexpr auto along_cosine = 0.8;
/// A body's place on the way is looked for so far round its place if the way
/// were straight.
constexpr auto foot_within_m = 20.0;
/// Less is a body that stands, with the sensor's noise.
constexpr auto stands_mps = 0.3;

/// A body as seen from the way.
struct seen_body {
  double ahead_m;     // from front bumper to it; negative: beside, or behind
  double behind_m;    // from it to the rear bumper; negative: beside, or ahead
  double beside_m;    // between the bodies, across; negative: in the own lane
  double along_mps;   // as the way leads
  double nearing_mps; // across, towards the own vehicle
  double own_nearing_mps; // and the own one towards it
  double speed_mps;
  bool is_along; // or against it
};

class look {
public:
  look(const safety_scene& x, const world::vehicle_params& car)
      : x_{x}, car_{car}, here_{x.way.path().frame(x.s_m)} {}

  double along_mps() const { return x_.speed_mps * std::cos(x_.turned_rad); }
  double front_m() const { return x_.s_m + car_.front_m; }

  std::optional<seen_body> at(const world::perceived_object& o,
                              double farthest_m) const {
    const auto to = o.centre - here_.at;
    if (dot(to, to) > farthest_m * farthest_m)
      return std::nullopt;
    const auto& path = x_.way.path();
    const auto guess_m = x_.s_m + dot(to, here_.tangent);
    const auto foot = path.project(o.centre, guess_m, foot_within_m);
    const auto lane = path.frame(foot.s_m);
    const point axis{std::cos(o.heading_rad), std::sin(o.heading_rad)};
    const auto c = dot(lane.tangent, axis), s = cross(lane.tangent, axis);
    const auto is_along = std::abs(c) > along_cosine;
    const auto half_length_m =
        (std::abs(c) * o.length_m + std::abs(s) * o.width_m) / 2;
    // Who follows the lane is turned as it is.
    const auto half_width_m =
        is_along ? o.width_m / 2
                 : (std::abs(s) * o.length_m + std::abs(c) * o.width_m) / 2;
    const auto s_m = foot.s_m + foot.beyond_m;
    const auto left_m = foot.d_m - x_.d_m;
    const auto side = left_m > 0 ? 1.0 : -1.0;
    return seen_body{s_m - half_length_m - front_m(),
                     x_.s_m - car_.rear_m - s_m - half_length_m,
                     std::abs(left_m) - half_width_m - half_width_of_own(),
                     o.speed_mps * c,
                     is_along ? 0.0 : -side * o.speed_mps * s,
                     side * x_.speed_mps * std::sin(x_.turned_rad),
                     o.speed_mps,
                     is_along};
  }

private:
  // Turned, it is wider.
  double half_width_of_own() const {
    const auto length_m = car_.front_m + car_.rear_m;
    return (car_.width_m + std::abs(std::sin(x_.turned_rad)) * length_m) / 2;
  }

  const safety_scene& x_;
  const world::vehicle_params& car_;
  world::path_frame here_;
};

/// Who drives along the way, or against it.
safe_response beside_or_along(const seen_body& o, double own_mps,
                              const rss_assumptions& assumed) {
  const auto across_s =
      meets_safely_s({o.beside_m, o.own_nearing_mps, o.nearing_mps},
                     assumed.lat, assumed.others_response_s);
  if (o.along_mps < -stands_mps) {
    const auto along_s = meets_safely_s({o.ahead_m, own_mps, -o.along_mps},
                                        assumed.lon, assumed.others_response_s);
    return {std::max(across_s, along_s), "oncoming"};
  }
  const auto along_s = follows_safely_s(
      {o.ahead_m, own_mps, std::max(0.0, o.along_mps)}, assumed.lon);
  return {std::max(across_s, along_s), "follow"};
}

/// Who comes from the side.
std::optional<safe_response> crossing(const seen_body& o, double own_mps,
                                      bool has_priority,
                                      const rss_assumptions& assumed) {
  const auto stop_s = longest_response_s(own_mps, o.ahead_m, assumed.lon);
  if (o.beside_m <= 0 && (o.speed_mps < stands_mps || !has_priority))
    return safe_response{stop_s, "crossing"};
  if (has_priority || o.nearing_mps <= stands_mps)
    return std::nullopt;
  // Along its own way to the own lane.
  const auto room_m = o.beside_m * o.speed_mps / o.nearing_mps;
  const auto stops_m =
      farthest_m(o.speed_mps, assumed.others_response_s, assumed.lon);
  if (stops_m <= room_m)
    return std::nullopt;
  return safe_response{stop_s, "crossing"};
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
  const look from{x, car};
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
    if (body->is_along)
      take(beside_or_along(*body, own_mps, assumed));
    else if (const auto one = crossing(*body, own_mps, x.has_priority, assumed))
      take(*one);
  }
  assert(least.longest_s >= 0 && least.longest_s <= most_s);
  return least;
}

} // namespace sofof::planners
