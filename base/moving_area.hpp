// An area that stays, or that moves with a vehicle.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <utility>
#include <vector>

namespace sofof {

/// A shape that stays where it is until it is moved; from then on it goes on at
/// constant velocity until it is moved again.
class moving_area {
public:
  moving_area() = default;
  /// @param shape  As it lies while nobody moves it, m, east-north.
  explicit moving_area(polygon shape) : shape_{std::move(shape)} {}

  /// At this time the shape's frame lies here and moves like this.
  void move(point to, point velocity_mps, time_point at) {
    moved_by_m_ = to;
    velocity_mps_ = velocity_mps;
    moved_at_ = at;
  }

  /// @returns whether the area holds a point at a time, which may be before it
  /// was last moved.
  bool contains(point p, time_point t) const {
    return shape_.contains(p - offset_m(t));
  }

  /// @returns where it lies then.
  polygon at(time_point t) const {
    const auto by_m = offset_m(t);
    if (by_m == point{})
      return shape_;
    std::vector<point> corners;
    for (const auto corner : shape_.corners())
      corners.push_back(corner + by_m);
    return polygon{std::move(corners)};
  }

  point velocity_mps() const { return velocity_mps_; }
  time_point moved_at() const { return moved_at_; } ///< Zero: never.

private:
  point offset_m(time_point t) const {
    if (velocity_mps_ == point{})
      return moved_by_m_;
    return moved_by_m_ + to_seconds(t - moved_at_) * velocity_mps_;
  }

  polygon shape_;
  point moved_by_m_;
  point velocity_mps_;
  time_point moved_at_{};
};

} // namespace sofof
