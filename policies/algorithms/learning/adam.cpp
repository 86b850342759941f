// Steps down a slope, each weight at its own pace.
#include "policies/algorithms/learning/adam.hpp"

#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

constexpr double mean_factor = 0.9;
constexpr double square_factor = 0.999;
constexpr double least_divisor = 1e-8;

} // namespace

void adam::step(Eigen::VectorXd& weights, const Eigen::VectorXd& gradient) {
  assert(gradient.size() == weights.size());
  mean_decay_ *= mean_factor;
  square_decay_ *= square_factor;
  mean_ += (1 - mean_factor) * (gradient - mean_);
  square_ += (1 - square_factor) * (gradient.cwiseAbs2() - square_);
  const auto step = rate_ / (1 - mean_decay_);
  const auto correction = 1 / std::sqrt(1 - square_decay_);
  weights.array() -= step * mean_.array()
                     / (square_.array().sqrt() * correction + least_divisor);
}

} // namespace sofof::policies
