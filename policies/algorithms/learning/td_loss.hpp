// How wrong the values of a batch of actions are.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace sofof::policies {

/// The mean over a batch of ½ d² where |d| ≤ 1, else |d| − ½; d is the value
/// of the action taken less its target (Huber 1964; Mnih et al. 2015 clip the
/// error so).
/// @param values   actions × batch.
/// @param actions  Taken, one per column.
/// @param targets  One per column.
/// @param slopes   Gets the loss's slope by each value, actions × batch.
double td_loss(const Eigen::MatrixXd& values,
               std::span<const std::size_t> actions,
               std::span<const double> targets, Eigen::MatrixXd& slopes);

} // namespace sofof::policies
