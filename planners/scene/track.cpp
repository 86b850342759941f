// A body on the road as it is known from sightings.
#include "planners/scene/track.hpp"

#include <Eigen/LU>

#include <cassert>
#include <cmath>

namespace sofof::planners {

void motion_estimate::advance(double dt_s, double manoeuvre_m2ps3) {
  assert(dt_s >= 0 && manoeuvre_m2ps3 >= 0);
  const auto q = manoeuvre_m2ps3;
  mean.col(0) += dt_s * mean.col(1);
  auto& p = covariance;
  p(0, 0) += dt_s * (2 * p(0, 1) + dt_s * (p(1, 1) + dt_s * q / 3));
  p(0, 1) += dt_s * (p(1, 1) + dt_s * q / 2);
  p(1, 0) = p(0, 1);
  p(1, 1) += dt_s * q;
  assert(p(0, 0) >= 0 && p(1, 1) >= 0 && p.determinant() >= 0);
}

void motion_estimate::fuse(const motion_estimate& other) {
  const Eigen::Matrix2d sum = covariance + other.covariance;
  assert(sum(0, 0) > 0 && sum.determinant() > 0);
  const Eigen::Matrix2d gain = covariance * sum.inverse();
  mean += (other.mean - mean) * gain.transpose();
  covariance -= gain * covariance;
  covariance(1, 0) = covariance(0, 1);
  assert(covariance(0, 0) > 0 && covariance(1, 1) > 0);
}

motion_estimate::mismatch
motion_estimate::compare(const motion_estimate& other) const {
  const Eigen::Matrix2d sum = covariance + other.covariance;
  assert(sum(0, 0) > 0 && sum.determinant() > 0);
  const Eigen::Matrix2d apart = other.mean - mean;
  const auto distance2 = (apart * sum.inverse()).cwiseProduct(apart).sum();
  return {distance2, distance2 + 2 * std::log(sum.determinant())};
}

track predict(track x, time_point then) {
  if (then > x.at) {
    x.motion.advance(to_seconds(then - x.at),
                     x.stands() ? motion_estimate::standing_m2ps3
                                : motion_estimate::driven_m2ps3);
    x.at = then;
  }
  return x;
}

} // namespace sofof::planners
