// The deep Q-network: slopes against differences, and what it learns against
// what is known.
#include "policies/algorithms/learning/dqn.hpp"

#include "policies/algorithms/learning/q_learning.hpp"
#include "policies/algorithms/learning/td_loss.hpp"
#include "tests/support/value_iteration.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;

TEST_CASE("the slopes of the loss are those of finite differences") {
  const random_stream draws{1, "slopes"};
  dueling_network network{{5, 3, 16}, draws.part("network")};
  // Offsets too: they are 0 at first.
  for (Eigen::Index i = 0; i < network.weights().size(); ++i)
    network.weights()[i] += draws.normal(0, 0.1, static_cast<std::uint64_t>(i));

  Eigen::MatrixXd states{5, 8};
  std::vector<std::size_t> actions;
  std::vector<double> targets;
  for (std::uint64_t k = 0; k < 8; ++k) {
    for (std::uint32_t i = 0; i < 5; ++i)
      states(i, static_cast<Eigen::Index>(k)) = draws.normal(0, 1, k, i);
    actions.push_back(k % 3);
    targets.push_back(draws.normal(0, 1, k, 9));
  }
  network_pass pass;
  Eigen::MatrixXd slopes;
  const auto loss = [&] {
    network.forward(states, pass);
    return td_loss(pass.values, actions, targets, slopes);
  };
  loss();
  Eigen::VectorXd gradient;
  network.backward(states, pass, slopes, gradient);

  double worst = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    constexpr double step = 1e-5;
    auto& weight = network.weights()[i];
    const auto kept = weight;
    weight = kept + step;
    const auto above = loss();
    weight = kept - step;
    const auto below = loss();
    weight = kept;
    worst =
        std::max(worst, std::abs((above - below) / (2 * step) - gradient[i]));
  }
  CHECK(worst < 1e-6 * gradient.lpNorm<Eigen::Infinity>());
}

namespace {

// A corridor of 8 cells; the left end pays 0.3, the right end 1, and both end
// the episode. Steps in between pay nothing. Right is best everywhere: from
// cell 0, 0.9^7 = 0.48 against 0.3.
constexpr std::size_t cells = 8;
constexpr std::size_t start = 2;
constexpr double corridor_discount = 0.9;
const auto left_or_right = first_actions(2);

finite_mdp corridor() {
  finite_mdp world{2, {}};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    world.outcomes.push_back({cell > 0 ? mdp_outcome{1, 0, cell - 1}
                                       : mdp_outcome{1, 0.3, std::nullopt}});
    world.outcomes.push_back({cell + 1 < cells
                                  ? mdp_outcome{1, 0, cell + 1}
                                  : mdp_outcome{1, 1, std::nullopt}});
  }
  return world;
}

std::array<double, cells> features_of(std::size_t cell) {
  std::array<double, cells> one_hot{};
  one_hot[cell] = 1;
  return one_hot;
}

// Lives a number of steps in the corridor.
template <class Choose, class Learn>
void live(const finite_mdp& world, int steps, Choose choose, Learn learn) {
  auto cell = start;
  for (int step = 0; step < steps; ++step) {
    const std::size_t action = choose(cell);
    const auto& outcome = world.outcomes[2 * cell + action][0];
    learn(cell, action, outcome);
    cell = outcome.next.value_or(start);
  }
}

// The mean distance of learned from exact values.
template <class Values>
double error(const std::vector<double>& exact, Values values) {
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    sum += std::abs(values(i / 2)[i % 2] - exact[i]);
  return sum / static_cast<double>(exact.size());
}

} // namespace

TEST_CASE("the deep Q-network learns a corridor as well as the table") {
  const auto world = corridor();
  const auto exact = value_iteration(world, corridor_discount, 1e-12);
  constexpr int steps = 2000;

  dqn_options options{{cells, 2}, corridor_discount};
  options.explore = {1, 0.3, 1000};
  dqn network{options, random_stream{1, "network"}};
  live(
      world, steps,
      [&](std::size_t cell) {
        return *network.choose(features_of(cell), left_or_right);
      },
      [&](std::size_t cell, std::size_t action, const mdp_outcome& outcome) {
        const auto here = features_of(cell);
        const auto there = features_of(outcome.next.value_or(0));
        std::span<const double> next;
        if (outcome.next)
          next = there;
        network.learn({here, action, outcome.reward, next, left_or_right});
      });

  q_learning table{{cells, 2, corridor_discount, std::nullopt, options.explore},
                   random_stream{1, "table"}};
  live(
      world, steps,
      [&](std::size_t cell) { return *table.choose(cell, left_or_right); },
      [&](std::size_t cell, std::size_t action, const mdp_outcome& outcome) {
        table.learn(
            {cell, action, outcome.reward, outcome.next, left_or_right});
      });

  for (std::size_t cell = 0; cell < cells; ++cell)
    CHECK(network.best(features_of(cell), left_or_right) == 1);
  const auto network_error = error(exact, [&](std::size_t cell) {
    return network.values(features_of(cell));
  });
  const auto table_error =
      error(exact, [&](std::size_t cell) { return table.values(cell); });
  CHECK(network_error < 0.05);
  CHECK(network_error <= table_error);
}
