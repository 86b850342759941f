// Cliff walking (Sutton & Barto 2018, example 6.6): the best way along the rim
// costs 13, the safe one, two rows up, 17.
#include "policies/algorithms/learning/q_learning.hpp"
#include "tests/support/cliff.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace sofof;
using namespace sofof::policies;

namespace {

const auto any_action = first_actions(test::cliff_actions);

q_learning learned(const q_learning_options& options, std::uint64_t seed,
                   int episodes) {
  q_learning learner{options, random_stream{seed, "cliff"}};
  for (int episode = 0; episode < episodes; ++episode)
    for (std::optional state = test::cliff_start; state;) {
      const auto action = *learner.choose(*state, any_action);
      const auto [reward, next] = test::step_on_cliff(*state, action);
      learner.learn({*state, action, reward, next, any_action});
      state = next;
    }
  return learner;
}

double greedy_return(const q_learning& learner) {
  return test::walk_the_cliff(
      [&](std::size_t state) { return *learner.best(state, any_action); });
}

q_learning_options undiscounted() {
  q_learning_options options{test::cliff_states, test::cliff_actions};
  options.discount = 1;
  options.explore = {0.1, 0.1};
  return options;
}

// SARSA, the book's contrast, values its own, ε-greedy behaviour.
double greedy_return_of_sarsa(std::uint64_t seed, int episodes) {
  constexpr double rate = 0.1;
  std::array<std::array<double, test::cliff_actions>, test::cliff_states> q{};
  const random_stream draws{seed, "sarsa"};
  std::uint64_t decision = 0;
  const auto choose = [&](std::size_t state) {
    return *explore_or_best(q[state], any_action, 0.1, draws, decision++);
  };
  for (int episode = 0; episode < episodes; ++episode) {
    std::optional state = test::cliff_start;
    for (auto action = choose(*state); state;) {
      const auto [reward, next] = test::step_on_cliff(*state, action);
      auto& value = q[*state][action];
      const auto next_action = next ? choose(*next) : 0;
      const auto later = next ? q[*next][next_action] : 0;
      value += rate * (reward + later - value);
      state = next;
      action = next_action;
    }
  }
  return test::walk_the_cliff(
      [&](std::size_t state) { return *best_action(q[state], any_action); });
}

} // namespace

TEST_CASE("Q-learning finds the best way along the cliff") {
  auto options = undiscounted();
  options.learning_rate = 0.5;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    CHECK(greedy_return(learned(options, seed, 500)) == -13);
}

TEST_CASE("Q-learning with a falling rate finds it too, later") {
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    CHECK(greedy_return(learned(undiscounted(), seed, 5000)) == -13);
}

TEST_CASE("SARSA keeps away from the rim") {
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    mean += greedy_return_of_sarsa(seed, 3000) / 20;
  CHECK(mean <= -15);
  CHECK(mean >= -17);
}
