// Tests of learning with a neural network.
#include "policies/algorithms/learning/dqn.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace sofof;
using namespace sofof::policies;

namespace {

using state = std::array<double, 2>;

dqn_options small_network() {
  dqn_options options{{2, 3, 8}};
  options.batch = 4;
  options.memory = 50;
  options.target_copy_every = 10;
  options.explore = {0.5, 0.1, 100};
  return options;
}

state drawn_state(const random_stream& draws, std::uint64_t step) {
  return {draws.normal(0, 1, step, 0), draws.normal(0, 1, step, 1)};
}

// Decides and learns in a world that rewards action 2, which is forbidden in
// every second state.
std::vector<std::size_t> live(dqn& learner, std::uint64_t steps) {
  const random_stream draws{3, "world"};
  std::vector<std::size_t> chosen;
  for (std::uint64_t step = 0; step < steps; ++step) {
    const auto here = drawn_state(draws, step);
    const auto there = drawn_state(draws, step + 1);
    const action_set allowed{step % 2 == 0 ? 0b111u : 0b011u};
    const auto action = *learner.choose(here, allowed);
    CHECK(allowed[action]);
    chosen.push_back(action);
    learner.learn({here, action, action == 2 ? 1.0 : 0.0, there,
                   first_actions(step % 2 == 0 ? 2 : 3)});
  }
  return chosen;
}

} // namespace

TEST_CASE("a network never chooses what is not allowed") {
  dqn learner{small_network(), random_stream{1, "dqn"}};
  live(learner, 500);
  const random_stream draws{4, "states"};
  for (std::uint64_t step = 0; step < 100; ++step) {
    const auto somewhere = drawn_state(draws, step);
    CHECK(learner.best(somewhere, action_set{0b010}) == 1);
    CHECK(!learner.best(somewhere, {}));
    CHECK(!learner.choose(somewhere, {}));
  }
}

TEST_CASE("what pays at once is learned") {
  dqn learner{small_network(), random_stream{1, "dqn"}};
  live(learner, 4000);
  const random_stream draws{4, "states"};
  for (std::uint64_t step = 0; step < 20; ++step)
    CHECK(learner.best(drawn_state(draws, step), first_actions(3)) == 2);
}

TEST_CASE("the same seed learns the same, another seed something else") {
  std::array<std::string, 3> learned;
  for (std::size_t k = 0; k < 3; ++k) {
    dqn learner{small_network(), random_stream{k < 2 ? 1u : 2u, "dqn"}};
    live(learner, 200);
    learned[k] = learner.snapshot();
  }
  CHECK(learned[0] == learned[1]);
  CHECK(learned[0] != learned[2]);
}

TEST_CASE("a network does not learn before it has a batch") {
  dqn learner{small_network(), random_stream{1, "dqn"}};
  const state here{1, 2};
  const auto at_first = learner.values(here)[0];
  for (int k = 0; k < 3; ++k) {
    learner.learn({here, 0, 5, {}, {}});
    CHECK(learner.values(here)[0] == at_first);
  }
  learner.learn({here, 0, 5, {}, {}});
  CHECK(learner.values(here)[0] > at_first);
}

TEST_CASE(
    "what is not allowed next, or comes after the end, is not hoped for") {
  // The first place leads to the second, where action 1 pays 2 and ends all.
  constexpr state first{1, 0};
  constexpr state second{0, 1};
  for (const auto hopeful : {false, true}) {
    auto options = small_network();
    options.discount = 0.5;
    options.rate = 0.01;
    dqn learner{options, random_stream{1, "dqn"}};
    for (int k = 0; k < 500; ++k) {
      learner.learn({second, 0, 0, {}, first_actions(3)});
      learner.learn({second, 1, 2, {}, first_actions(3)});
      learner.learn({first, 0, 0, second, action_set{hopeful ? 0b11u : 0b01u}});
    }
    CHECK(std::abs(learner.values(second)[1] - 2) < 0.05);
    CHECK(std::abs(learner.values(first)[0] - (hopeful ? 1 : 0)) < 0.05);
  }
}

TEST_CASE("values differ from their mean by the advantages") {
  const dueling_network network{{2, 3, 8}, random_stream{1, "network"}};
  network_pass pass;
  network.forward(Eigen::MatrixXd::Ones(2, 1), pass);
  CHECK(pass.values.mean() == doctest::Approx(pass.head(0, 0)));
  CHECK(pass.values(1, 0) - pass.values(0, 0)
        == doctest::Approx(pass.head(2, 0) - pass.head(1, 0)));
}

TEST_CASE("Adam's first step is as long as its rate, whatever the slope") {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(3);
  adam optimiser{3, 0.01};
  optimiser.step(weights, Eigen::Vector3d{5, -0.001, 0});
  CHECK(weights[0] == doctest::Approx(-0.01));
  CHECK(weights[1] == doctest::Approx(0.01));
  CHECK(weights[2] == 0);
}

TEST_CASE("a memory keeps the latest experiences whole") {
  replay memory{2, 3};
  for (int k = 0; k < 5; ++k) {
    const state here{1.0 * k, 10.0 * k};
    const state there{-1.0 * k, -10.0 * k};
    memory.add({here, 1u * k, 0.5 * k,
                k == 4 ? std::span<const double>{} : std::span{there},
                action_set{3u + k}});
    CHECK(memory.size() == std::min<std::size_t>(k + 1, 3));
  }
  // 3 and 4 have taken the places of 0 and 1.
  CHECK(memory[2].action == 2);
  CHECK(memory[0].state[1] == 30);
  CHECK(memory[0].next[0] == -3);
  CHECK(memory[0].reward == 1.5);
  CHECK(memory[0].next_allowed == action_set{6});
  CHECK(memory[1].action == 4);
  CHECK(memory[1].next.empty());
}
