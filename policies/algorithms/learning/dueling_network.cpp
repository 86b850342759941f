// A small neural network that values actions.
#include "policies/algorithms/learning/dueling_network.hpp"

#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The layers as views into one vector: first, second, head.
template <class Vector, class Matrix, class Column>
struct layers {
  layers(Vector& all, const network_shape& shape)
      : layers{all.data(), shape.features, shape.width, 1 + shape.actions} {}

  Eigen::Map<Matrix> first, second, head;
  Eigen::Map<Column> first_offset, second_offset, head_offset;

private:
  template <class Pointer>
  layers(Pointer data, Index features, Index width, Index outputs)
      : first{data, width, features}, second{data + width * (features + 1),
                                             width, width},
        head{second.data() + width * (width + 1), outputs, width},
        first_offset{data + width * features, width},
        second_offset{second.data() + width * width, width},
        head_offset{head.data() + outputs * width, outputs} {}
};
using const_layers = layers<const VectorXd, const MatrixXd, const VectorXd>;
using mutable_layers = layers<VectorXd, MatrixXd, VectorXd>;

Index number_of_weights(const network_shape& shape) {
  return shape.width * (shape.features + 1) + shape.width * (shape.width + 1)
         + (1 + shape.actions) * (shape.width + 1);
}

// Sums over the batch in one order, wherever the memory lies.
template <class Column>
void sum_columns(const MatrixXd& terms, Column& sum) {
  sum.setZero();
  for (Index k = 0; k < terms.cols(); ++k)
    sum += terms.col(k);
}

} // namespace

dueling_network::dueling_network(const network_shape& shape,
                                 const random_stream& draws)
    : shape_{shape}, weights_{VectorXd::Zero(number_of_weights(shape))} {
  std::uint64_t drawn = 0;
  mutable_layers all{weights_, shape_};
  for (auto* layer : {&all.first, &all.second, &all.head}) {
    const auto spread = std::sqrt(2.0 / static_cast<double>(layer->cols()));
    for (Index k = 0; k < layer->size(); ++k)
      layer->data()[k] = draws.normal(0, spread, drawn++);
  }
}

void dueling_network::forward(const Eigen::Ref<const MatrixXd>& states,
                              network_pass& pass) const {
  assert(states.rows() == shape_.features);
  const const_layers all{weights_, shape_};
  pass.first.noalias() = all.first * states;
  pass.first.colwise() += all.first_offset;
  pass.first = pass.first.cwiseMax(0.0);

  pass.second.noalias() = all.second * pass.first;
  pass.second.colwise() += all.second_offset;
  pass.second = pass.second.cwiseMax(0.0);

  pass.head.noalias() = all.head * pass.second;
  pass.head.colwise() += all.head_offset;

  pass.values.resize(shape_.actions, states.cols());
  for (Index k = 0; k < states.cols(); ++k) {
    double advantages = 0;
    for (Index a = 1; a <= shape_.actions; ++a)
      advantages += pass.head(a, k);
    const auto base =
        pass.head(0, k) - advantages / static_cast<double>(shape_.actions);
    for (Index a = 0; a < shape_.actions; ++a)
      pass.values(a, k) = base + pass.head(1 + a, k);
  }
}

void dueling_network::backward(const Eigen::Ref<const MatrixXd>& states,
                               network_pass& pass, const MatrixXd& slopes,
                               VectorXd& gradient) const {
  assert(slopes.rows() == shape_.actions && slopes.cols() == states.cols());
  gradient.resize(weights_.size());
  const const_layers all{weights_, shape_};
  mutable_layers by{gradient, shape_};

  for (Index k = 0; k < states.cols(); ++k) {
    double total = 0;
    for (Index a = 0; a < shape_.actions; ++a)
      total += slopes(a, k);
    pass.head(0, k) = total;
    const auto mean = total / static_cast<double>(shape_.actions);
    for (Index a = 0; a < shape_.actions; ++a)
      pass.head(1 + a, k) = slopes(a, k) - mean;
  }
  by.head.noalias() = pass.head * pass.second.transpose();
  sum_columns(pass.head, by.head_offset);

  // A unit that gives nothing passes no slope on.
  pass.slopes.noalias() = all.head.transpose() * pass.head;
  pass.second = (pass.second.array() > 0).select(pass.slopes, 0);
  by.second.noalias() = pass.second * pass.first.transpose();
  sum_columns(pass.second, by.second_offset);

  pass.slopes.noalias() = all.second.transpose() * pass.second;
  pass.first = (pass.first.array() > 0).select(pass.slopes, 0);
  by.first.noalias() = pass.first * states.transpose();
  sum_columns(pass.first, by.first_offset);
}

} // namespace sofof::policies
