// Which lines of sight the buildings of a map leave free.
#include "planners/scene/line_of_sight.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

constexpr double house_cell_m = 50;

/// @returns whether the segment from `a` to `b` meets the segment from `c` to
/// `d`; one that only touches the end of the other may count or not.
bool meet(point a, point b, point c, point d) {
  const auto is_left = [](point from, point to, point p) {
    return cross(to - from, p - from) > 0;
  };
  return is_left(a, b, c) != is_left(a, b, d)
         && is_left(c, d, a) != is_left(c, d, b);
}

bool meets_rim(point a, point b, std::span<const point> rim) {
  assert(rim.size() >= 3);
  auto from = rim.back();
  for (const auto to : rim) {
    if (meet(a, b, from, to))
      return true;
    from = to;
  }
  return false;
}

} // namespace

bool crosses(point a, point b, const oriented_box& box) {
  assert(box.length_m >= 0 && box.width_m >= 0);
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  const auto forward = box.length_m / 2 * along;
  const auto left = box.width_m / 2 * point{-along.y_m, along.x_m};
  const auto radius_m = std::hypot(box.length_m, box.width_m) / 2;
  if (distance_to_segment_m(box.centre, a, b) > radius_m)
    return false;
  const std::array rim{box.centre + forward + left, box.centre - forward + left,
                       box.centre - forward - left,
                       box.centre + forward - left};
  return overlap(box, {a}) || overlap(box, {b}) || meets_rim(a, b, rim);
}

line_of_sight::line_of_sight(std::span<const world::building> buildings)
    : cells_{house_cell_m} {
  for (const auto& b : buildings) {
    const auto [west, east] =
        std::ranges::minmax_element(b.corners, {}, &point::x_m);
    house h{polygon{b.corners}, {}, 0};
    const auto [south, north] =
        std::ranges::minmax_element(b.corners, {}, &point::y_m);
    h.middle = {(west->x_m + east->x_m) / 2, (south->y_m + north->y_m) / 2};
    for (const auto p : b.corners)
      h.radius_m = std::max(h.radius_m, distance_m(h.middle, p));
    assert(h.radius_m > 0 && std::isfinite(h.radius_m));
    largest_m_ = std::max(largest_m_, h.radius_m);
    assert(largest_m_ >= h.radius_m);
    cells_.add(h.middle, h.middle, 0,
               static_cast<cell_grid::item>(houses_.size()));
    houses_.push_back(std::move(h));
  }
}

bool line_of_sight::is_free(point eye, point p) const {
  if (houses_.empty())
    return true;
  const auto middle = 0.5 * (eye + p);
  const auto reach_m = distance_m(eye, p) / 2 + largest_m_;
  assert(largest_m_ > 0);
  return !cells_.any_near(middle, reach_m, [&](cell_grid::item i) {
    assert(i < houses_.size());
    const auto& h = houses_[i];
    return distance_to_segment_m(h.middle, eye, p) <= h.radius_m
           && !h.shape.contains(eye)
           && (h.shape.contains(p) || meets_rim(eye, p, h.shape.corners()));
  });
}

} // namespace sofof::planners
