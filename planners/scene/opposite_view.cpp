// What a car sees of the lane opposite its own.
#include "planners/scene/opposite_view.hpp"

#include "planners/scene/corridor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

constexpr double opposite_step_m = 4, sight_step_m = 2;
/// Who reaches so far into the opposite lane is on it.
constexpr double reaches_in_m = 0.3;
/// Who looks past a body is so far left of its edge, over the middle of the
/// street by so much at most, and has come there so far before it stops.
constexpr double past_edge_m = 0.1, over_middle_m = 0.25, shifted_m = 6;
/// Less is not worth steering.
constexpr double least_shift_m = 0.1;
/// Headings against the own one to within 60° are those of who comes.
constexpr double against_cosine = -0.5;

/// @returns the nearest of the steps along a stretch of the way.
double nearest_m(const world::route& way, double from_m, double to_m, point p) {
  auto nearest = from_m;
  auto least = std::numeric_limits<double>::infinity();
  for (auto s = from_m; s <= to_m; s += opposite_step_m)
    if (const auto away_m = distance_m(way.path().at(s).at, p); away_m < least)
      least = away_m, nearest = s;
  return nearest;
}

} // namespace

void add_if_opposite(const world::route& way, double from_m, double to_m,
                     const track& x, std::vector<oncoming_body>& out) {
  assert(from_m <= to_m && x.length_m > 0);
  const auto guess_m = nearest_m(way, from_m, to_m, x.centre());
  const auto on = way.path().project(x.centre(), guess_m, 2 * opposite_step_m);
  const auto turned_rad = x.heading_rad - way.path().at(on.s_m).heading_rad;
  const auto c = std::abs(std::cos(turned_rad));
  const auto s = std::abs(std::sin(turned_rad));
  const auto along_m = (c * x.length_m + s * x.width_m) / 2;
  const auto across_m = (s * x.length_m + c * x.width_m) / 2;
  const auto bounds = way.bounds_at(on.s_m);
  if (on.s_m + along_m < from_m || on.s_m - along_m > to_m
      || on.d_m + across_m < bounds.half_width_m + reaches_in_m
      || on.d_m - across_m > bounds.left_m)
    return;
  assert(along_m > 0 && across_m > 0);
  const auto comes = std::cos(turned_rad) < against_cosine;
  out.push_back({on.s_m - along_m, on.s_m + along_m,
                 comes ? std::max(0.0, x.speed_mps()) : 0.0});
}

double opposite_in_sight_m(const world::route& way, point eye, double from_m,
                           double range_m, const line_of_sight* houses,
                           const oriented_box& hides) {
  assert(range_m >= 0 && std::isfinite(from_m));
  auto seen_m = from_m;
  for (;;) {
    const auto next_m = seen_m + sight_step_m;
    if (!way.closed() && next_m > way.length_m())
      return std::numeric_limits<double>::infinity(); // who is there has left
    const auto bounds = way.bounds_at(next_m);
    const auto here = way.path().at(next_m);
    const point left{-std::sin(here.heading_rad), std::cos(here.heading_rad)};
    const auto middle =
        here.at + (bounds.half_width_m + bounds.left_m) / 2 * left;
    if (distance_m(eye, middle) > range_m || crosses(eye, middle, hides)
        || (houses && !houses->is_free(eye, middle)))
      return seen_m;
    assert(next_m > seen_m);
    seen_m = next_m;
  }
}

std::optional<lane_obstacle> look_past(double body_left_m, double rests_m,
                                       double half_lane_m,
                                       const world::vehicle_params& car) {
  assert(half_lane_m > 0 && car.width_m > 0);
  const auto middle_m = std::min(body_left_m + past_edge_m,
                                 half_lane_m + over_middle_m - car.width_m / 2);
  if (middle_m < least_shift_m)
    return std::nullopt;
  // The least that leaves a car room beside it there, and no more.
  const auto right_m = middle_m - (corridor::room_beside_m - car.width_m / 2);
  const auto room_m = corridor::room_beside_m + right_m + 2 * least_shift_m;
  return lane_obstacle{
      rests_m - car.front_m - shifted_m,  rests_m, -half_lane_m, right_m, 0, 0,
      std::max(0.0, room_m - half_lane_m)};
}

} // namespace sofof::planners
