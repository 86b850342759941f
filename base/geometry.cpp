// Plane geometry in metres: points, polygons, polylines.
#include "base/geometry.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sofof {

namespace {

constexpr double rounding = 1e-9;

/// Twice the signed area of a triangle: positive when c lies left of a->b.
double turn(point a, point b, point c) {
  return cross(b - a, c - a);
}

/// @returns whether p, known to be collinear with a and b, lies between them.
bool between(point p, point a, point b) {
  return std::min(a.x_m, b.x_m) <= p.x_m && p.x_m <= std::max(a.x_m, b.x_m)
         && std::min(a.y_m, b.y_m) <= p.y_m && p.y_m <= std::max(a.y_m, b.y_m);
}

bool on_segment(point p, point a, point b) {
  return turn(a, b, p) == 0 && between(p, a, b);
}

/// @returns whether two segments share a point, ends included.
bool touch(point a, point b, point c, point d) {
  auto left = [](double x) { return x > 0; };
  auto right = [](double x) { return x < 0; };
  const auto abc = turn(a, b, c), abd = turn(a, b, d);
  const auto cda = turn(c, d, a), cdb = turn(c, d, b);
  const auto split_ab = (left(abc) && right(abd)) || (right(abc) && left(abd));
  const auto split_cd = (left(cda) && right(cdb)) || (right(cda) && left(cdb));
  return (split_ab && split_cd) || on_segment(c, a, b) || on_segment(d, a, b)
         || on_segment(a, c, d) || on_segment(b, c, d);
}

/// @returns whether edge i runs back over the edge before it.
bool folds_back(std::span<const point> corners, std::size_t i) {
  const auto n = corners.size();
  const auto a = corners[i], b = corners[(i + 1) % n], c = corners[(i + 2) % n];
  return turn(a, b, c) == 0 && dot(b - a, c - b) < 0;
}

bool crosses_itself(std::span<const point> corners) {
  const auto n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (folds_back(corners, i))
      return true;
    for (auto j = i + 2; j < n; ++j) {
      const auto neighbours = i == 0 && j == n - 1;
      if (!neighbours
          && touch(corners[i], corners[i + 1], corners[j],
                   corners[(j + 1) % n]))
        return true;
    }
  }
  return false;
}

/// Half the extent of a box along a unit vector, m.
double reach_m(const oriented_box& box, point axis) {
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  return 0.5
         * (box.length_m * std::abs(dot(along, axis))
            + box.width_m * std::abs(cross(along, axis)));
}

} // namespace

double wrap_angle(double angle_rad) {
  constexpr auto pi = std::numbers::pi;
  const auto wrapped = std::remainder(angle_rad, 2 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

polygon::polygon(std::vector<point> corners) : corners_{std::move(corners)} {
  const auto n = corners_.size();
  if (n < 3)
    throw std::invalid_argument{"A polygon needs at least three corners."};
  for (std::size_t i = 0; i < n; ++i)
    if (corners_[i] == corners_[(i + 1) % n])
      throw std::invalid_argument{"Two neighbouring corners of a polygon "
                                  "coincide."};
  if (crosses_itself(corners_))
    throw std::invalid_argument{"The rim of a polygon crosses itself."};
  for (const auto corner : corners_)
    middle_ = middle_ + 1 / static_cast<double>(n) * corner;
  const auto has_middle = casts_oddly(middle_);
  auto within_m = std::numeric_limits<double>::infinity(), beyond_m = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto a = corners_[i], b = corners_[(i + 1) % n];
    within_m = std::min(within_m, distance_to_segment_m(middle_, a, b));
    beyond_m = std::max(beyond_m, distance_m(middle_, a));
  }
  // Rounding must not decide.
  within_m2_ = has_middle ? within_m * within_m * (1 - rounding) : 0;
  beyond_m2_ = beyond_m * beyond_m * (1 + rounding);
}

polygon polygon::regular(point centre, double radius_m, unsigned corners) {
  std::vector<point> rim;
  rim.reserve(corners);
  for (unsigned i = 0; i < corners; ++i) {
    const auto angle = 2 * std::numbers::pi * i / corners;
    rim.push_back(centre + radius_m * point{std::cos(angle), std::sin(angle)});
  }
  return polygon{std::move(rim)};
}

bool polygon::contains(point p) const {
  const auto away_m2 = dot(p - middle_, p - middle_);
  if (away_m2 < within_m2_)
    return true;
  return !(away_m2 > beyond_m2_) && casts_oddly(p);
}

// Counts how often a ray crosses the rim.
bool polygon::casts_oddly(point p) const {
  auto inside = false;
  for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size();
       j = i++) {
    const auto a = corners_[j], b = corners_[i];
    if (on_segment(p, a, b))
      return true;
    if ((a.y_m > p.y_m) != (b.y_m > p.y_m)
        && (turn(a, b, p) > 0) == (b.y_m > a.y_m))
      inside = !inside;
  }
  return inside;
}

double distance_to_segment_m(point p, point a, point b) {
  const auto ab = b - a;
  const auto square = dot(ab, ab);
  const auto share =
      square > 0 ? std::clamp(dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
  return distance_m(p, a + share * ab);
}

double length_m(std::span<const point> polyline) {
  double sum = 0;
  for (std::size_t i = 1; i < polyline.size(); ++i)
    sum += distance_m(polyline[i - 1], polyline[i]);
  return sum;
}

bool overlap(const oriented_box& a, const oriented_box& b) {
  const auto apart = b.centre - a.centre;
  for (const auto heading : {a.heading_rad, b.heading_rad}) {
    const point along{std::cos(heading), std::sin(heading)};
    const point across{-along.y_m, along.x_m};
    for (const auto axis : {along, across})
      if (std::abs(dot(apart, axis)) > reach_m(a, axis) + reach_m(b, axis))
        return false;
  }
  return true;
}

} // namespace sofof
