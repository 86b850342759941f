// Plane geometry in metres: points, polygons, polylines.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sofof {

/// A point or vector in the local east-north frame of the map, m.
struct point {
  double x_m = 0;
  double y_m = 0;

  friend bool operator==(const point&, const point&) = default;
  friend point operator+(point a, point b) {
    return {a.x_m + b.x_m, a.y_m + b.y_m};
  }
  friend point operator-(point a, point b) {
    return {a.x_m - b.x_m, a.y_m - b.y_m};
  }
  friend point operator*(double k, point a) { return {k * a.x_m, k * a.y_m}; }
};

void visit_fields(auto& v, point& x) {
  v("x_m", x.x_m);
  v("y_m", x.y_m);
}

inline double dot(point a, point b) {
  return a.x_m * b.x_m + a.y_m * b.y_m;
}

inline double cross(point a, point b) {
  return a.x_m * b.y_m - a.y_m * b.x_m;
}

inline double distance_m(point a, point b) {
  return std::sqrt(dot(b - a, b - a));
}

/// @returns the angle wrapped to (-pi, pi].
double wrap_angle(double angle_rad);

/// A simple polygon; its rim counts as inside.
class polygon {
public:
  polygon() = default;

  /// @param corners  In order, either sense, m; first and last are joined.
  /// @throws std::invalid_argument with a sentence when there are fewer than
  ///         three corners, two neighbours coincide, or the rim crosses
  ///         itself.
  explicit polygon(std::vector<point> corners);

  /// Regular polygon inscribed in a circle; the first corner lies due east.
  static polygon regular(point centre, double radius_m, unsigned corners);

  /// @returns them as given; of a temporary polygon, a copy that lives on.
  std::span<const point> corners() const& { return corners_; }
  std::vector<point> corners() && { return std::move(corners_); }

  /// Ray casting near the rim, O(corners); O(1) in the middle and far away.
  bool contains(point p) const;

private:
  bool casts_oddly(point p) const;

  std::vector<point> corners_;
  point middle_;
  double within_m2_ = 0, beyond_m2_ = 0; // of the middle: all inside, outside
};

/// @returns the distance from `p` to the segment from `a` to `b`, m.
double distance_to_segment_m(point p, point a, point b);

/// @returns the sum of the distances between neighbours, m; 0 for fewer than
/// two points.
double length_m(std::span<const point> polyline);

/// A rectangle on the road: the footprint of a vehicle.
struct oriented_box {
  point centre;
  double heading_rad = 0; ///< Along its length, counter-clockwise from east.
  double length_m = 0;
  double width_m = 0;
};

/// @returns whether two boxes share a point (separating axes).
bool overlap(const oriented_box& a, const oriented_box& b);

} // namespace sofof
