// Measures on polylines.
#include "maps/polyline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::maps {

namespace {

constexpr auto look_m = 2.0;

point unit(point x) {
  const auto size = std::sqrt(dot(x, x));
  return size > 0 ? (1 / size) * x : point{1, 0};
}

double bend_between(point a, point b, point c) {
  const auto in = b - a, out = c - b;
  const auto turn_rad = std::abs(std::atan2(cross(in, out), dot(in, out)));
  const auto mean_m = (distance_m(a, b) + distance_m(b, c)) / 2;
  return mean_m > 0 ? turn_rad / mean_m : 0;
}

} // namespace

point line_walk::to(double s_m) {
  assert(!line_.empty());
  for (; segment_ + 1 < line_.size(); ++segment_) {
    const auto from = line_[segment_], next = line_[segment_ + 1];
    const auto length = distance_m(from, next);
    const auto on_m = std::max(s_m - begins_m_, 0.0);
    if (on_m <= length && length > 0)
      return from + (on_m / length) * (next - from);
    begins_m_ += length;
  }
  return line_.back();
}

point point_along(std::span<const point> line, double s_m) {
  return line_walk{line}.to(s_m);
}

std::vector<point> part_of(std::span<const point> line, double from_m,
                           double to_m) {
  std::vector<point> part{point_along(line, from_m)};
  auto s_m = 0.0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    s_m += distance_m(line[i - 1], line[i]);
    if (s_m > from_m && s_m < to_m)
      part.push_back(line[i]);
  }
  part.push_back(point_along(line, to_m));
  return part;
}

std::vector<point> without_doubles(std::span<const point> line) {
  constexpr auto same_m = 0.05;
  std::vector<point> kept{line.front()};
  for (const auto p : line)
    if (distance_m(kept.back(), p) >= same_m)
      kept.push_back(p);
  if (kept.size() > 1)
    kept.back() = line.back();
  return kept;
}

double distance_to_m(point p, std::span<const point> line) {
  auto least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    least = std::min(least, distance_to_segment_m(p, line[i], line[i + 1]));
  return least;
}

point direction_at_start(std::span<const point> line) {
  return unit(point_along(line, look_m) - line.front());
}

point direction_at_end(std::span<const point> line) {
  return unit(line.back() - point_along(line, length_m(line) - look_m));
}

double bend_1pm(std::span<const point> line, std::size_t i) {
  assert(i > 0 && i + 1 < line.size());
  return bend_between(line[i - 1], line[i], line[i + 1]);
}

double sharpest_of(std::span<const point> curve, const curve_ends& ends) {
  assert(curve.size() >= 2);
  const auto first_m = distance_m(curve[0], curve[1]);
  const auto last_m =
      distance_m(curve[curve.size() - 2], curve[curve.size() - 1]);
  auto sharpest =
      std::max(bend_between(curve.front() - first_m * ends.start_direction,
                            curve.front(), curve[1]),
               bend_between(curve[curve.size() - 2], curve.back(),
                            curve.back() + last_m * ends.end_direction));
  for (std::size_t i = 1; i + 1 < curve.size(); ++i)
    sharpest = std::max(sharpest, bend_1pm(curve, i));
  return sharpest;
}

} // namespace sofof::maps
