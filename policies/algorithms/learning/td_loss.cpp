// How wrong the values of a batch of actions are.
#include "policies/algorithms/learning/td_loss.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::policies {

double td_loss(const Eigen::MatrixXd& values,
               std::span<const std::size_t> actions,
               std::span<const double> targets, Eigen::MatrixXd& slopes) {
  assert(std::ssize(actions) == values.cols());
  assert(std::ssize(targets) == values.cols());
  slopes.setZero(values.rows(), values.cols());
  const auto batch = static_cast<double>(values.cols());
  double loss = 0;
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const auto n = static_cast<std::size_t>(k);
    const auto action = static_cast<Eigen::Index>(actions[n]);
    const auto error = values(action, k) - targets[n];
    const auto size = std::abs(error);
    loss += (size <= 1 ? 0.5 * error * error : size - 0.5) / batch;
    slopes(action, k) = std::clamp(error, -1.0, 1.0) / batch;
  }
  return loss;
}

} // namespace sofof::policies
