// A body on the road as it is known from sightings.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/time.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace sofof::planners {

/// Where something is and how it moves, and how well that is known: the state
/// of a Kalman filter. What is known is equally good in all directions, so
/// that east and north are two filters with one covariance.
struct motion_estimate {
  /// Columns: centre, m, and velocity, m/s; rows: east and north.
  Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
  /// Of position and velocity along any one axis; symmetric, m and m/s.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  /// Spectral density of the acceleration, m²/s³: drivers change it by 2 m/s²
  /// (standard deviation) about once a second, ...
  static constexpr double driven_m2ps3 = 4.0;
  /// ... and what stands mostly goes on standing.
  static constexpr double standing_m2ps3 = 0.05;

  /// Lets time pass: at constant velocity, but for random manoeuvres
  /// (acceleration is white noise), which make the estimate less certain.
  /// Source: Bar-Shalom, Li & Kirubarajan 2001, section 6.2.2.
  /// @param dt_s  >= 0.
  void advance(double dt_s, double manoeuvre_m2ps3 = driven_m2ps3);

  /// Makes the most of two independent estimates of one body at one time.
  void fuse(const motion_estimate& other);

  /// How badly two estimates agree, if they are of one body.
  struct mismatch {
    double distance2; ///< Squared Mahalanobis distance, 4 degrees of freedom.
    double cost;      ///< Minus twice the log-likelihood, up to a constant.
  };
  mismatch compare(const motion_estimate& other) const;

  point centre() const { return {mean(0, 0), mean(1, 0)}; }
};

/// Slower than this, a body stands: sensors are not better.
inline constexpr double stands_below_mps = 0.3;

/// Where a body stands, from all sightings since it moved.
struct resting_place {
  point centre;
  double variance_m2 = 0; ///< Along any axis.
};

/// A body that has been seen on the road.
struct track {
  std::uint32_t id = 0;              ///< Counts the bodies ever seen.
  std::optional<station_id> station; ///< Of a vehicle that was heard.
  time_point at;                     ///< When `motion` holds.
  time_point seen;                   ///< When it was last seen or heard.
  time_point moved; ///< When it last moved; its first sighting if never.
  motion_estimate motion;
  double heading_rad = 0;      ///< Where its front is, known at rest as well.
  double accel_mps2 = 0;       ///< Along its heading.
  double length_m = 0;         ///< Along its heading.
  double width_m = 0;          ///< Across it.
  double heading_variance = 0; ///< rad².
  std::optional<resting_place> rest; ///< Holds while it stands.

  /// @returns the middle of the body.
  point centre() const {
    return rest && stands() ? rest->centre : motion.centre();
  }

  /// @returns the velocity along an axis.
  double speed_along_mps(double axis_rad) const {
    return motion.mean(0, 1) * std::cos(axis_rad)
           + motion.mean(1, 1) * std::sin(axis_rad);
  }

  double speed_mps() const { return speed_along_mps(heading_rad); }

  bool stands() const {
    // Mostly this is enough, without the axis.
    return motion.mean.col(1).squaredNorm()
               < stands_below_mps * stands_below_mps
           || std::abs(speed_mps()) < stands_below_mps;
  }

  /// @returns how far its side may be from where it is thought to be, m: three
  /// standard deviations, at the ends of what may be turned. Who drives may
  /// speed up and slow down, which makes its place uncertain, but keeps to its
  /// lane; what stands moves along its heading, if at all, so that its sides
  /// stay as they were seen.
  double margin_m() const {
    constexpr auto most_of_driven_m = 0.2;
    const auto half_m = std::max(length_m, width_m) / 2;
    const auto margin = [&](double of_place_m2) {
      return 3 * std::sqrt(of_place_m2 + half_m * half_m * heading_variance);
    };
    return stands() && rest
               ? margin(rest->variance_m2)
               : std::min(margin(motion.covariance(0, 0)), most_of_driven_m);
  }

  /// @returns the smaller of length and width: it may be wider than long.
  double narrow_m() const { return std::min(length_m, width_m); }

  oriented_box body() const {
    return {centre(), heading_rad, length_m, width_m};
  }
};

/// @returns `x` at a later time; as it is when `then` is not later.
track predict(track x, time_point then);

/// @param a_m, b_m  Of each body, the smaller of length and width.
/// @returns whether two bodies with a distance of this square between their
/// centres overlap whatever their headings: their inscribed circles do.
inline bool in_one_place(double distance2_m2, double a_m, double b_m) {
  const auto apart_m = 0.5 * (a_m + b_m);
  return distance2_m2 < apart_m * apart_m;
}

} // namespace sofof::planners
