// A small neural network that values actions.
#pragma once

#include "base/random.hpp"

#include <Eigen/Core>

namespace sofof::policies {

struct network_shape {
  Eigen::Index features = 1; ///< What a state is described by.
  Eigen::Index actions = 2;
  Eigen::Index width = 64; ///< Of each of the two hidden layers.
};

/// What a network computes of the states of a batch, a column each. Keep it
/// from one batch to the next of the same size: then no memory is asked for.
struct network_pass {
  Eigen::MatrixXd first;  ///< Hidden layer, width × batch.
  Eigen::MatrixXd second; ///< Hidden layer, width × batch.
  Eigen::MatrixXd head;   ///< 1 + actions × batch: V, and A of each action.
  Eigen::MatrixXd values; ///< Q, actions × batch.
  Eigen::MatrixXd slopes; ///< Of a hidden layer, width × batch.
};

/// Two hidden layers of rectified linear units and a dueling head:
///
///   Q(s, a) = V(s) + A(s, a) − mean over a′ of A(s, a′).
///
/// Sources: Glorot, Bordes & Bengio 2011 (units), He et al. 2015 (first
/// weights), Wang et al. 2016, eq. (9) (head).
class dueling_network {
public:
  /// With normal weights of variance 2 / inputs of a layer, and no offsets.
  dueling_network(const network_shape& shape, const random_stream& draws);

  const network_shape& shape() const { return shape_; }
  /// All weights and offsets, layer by layer.
  const Eigen::VectorXd& weights() const { return weights_; }
  Eigen::VectorXd& weights() { return weights_; }

  /// @param states  features × batch.
  /// @param pass    Gets the values, and what `backward` needs.
  void forward(const Eigen::Ref<const Eigen::MatrixXd>& states,
               network_pass& pass) const;

  /// @param states    As given to `forward`.
  /// @param pass      As `forward` left it; its layers become their slopes.
  /// @param slopes    Of a loss by the values, actions × batch.
  /// @param gradient  Gets the loss's by the weights, in their order.
  void backward(const Eigen::Ref<const Eigen::MatrixXd>& states,
                network_pass& pass, const Eigen::MatrixXd& slopes,
                Eigen::VectorXd& gradient) const;

private:
  network_shape shape_;
  Eigen::VectorXd weights_;
};

} // namespace sofof::policies
