// Steps down a slope, each weight at its own pace.
#pragma once

#include <Eigen/Core>

#include <cassert>

namespace sofof::policies {

/// Adam with the constants of its paper: means of gradients and of their
/// squares with factors 0.9 and 0.999, corrected for their start at 0.
/// Source: Kingma & Ba 2015, algorithm 1.
class adam {
public:
  /// @param rate  Longest usual step of a weight, > 0.
  adam(Eigen::Index weights, double rate = 1e-3)
      : rate_{rate}, mean_{Eigen::VectorXd::Zero(weights)},
        square_{Eigen::VectorXd::Zero(weights)} {
    assert(rate > 0);
  }

  /// @param gradient  As long as the weights.
  void step(Eigen::VectorXd& weights, const Eigen::VectorXd& gradient);

private:
  double rate_;
  Eigen::VectorXd mean_;
  Eigen::VectorXd square_;
  double mean_decay_ = 1; // powers of the factors
  double square_decay_ = 1;
};

} // namespace sofof::policies
