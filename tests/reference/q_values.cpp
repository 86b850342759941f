// Tabular learning against the exact values of small decision processes.
#include "policies/algorithms/learning/q_learning.hpp"
#include "tests/support/value_iteration.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;

namespace {

constexpr std::size_t states = 8;
constexpr std::size_t actions = 3;
constexpr double discount = 0.8;

// Any action leads to one of three random states or ends the episode.
finite_mdp random_world(std::uint64_t seed) {
  const random_stream draws{seed, "world"};
  finite_mdp world{actions, {}};
  for (std::uint64_t i = 0; i < states * actions; ++i) {
    std::vector<mdp_outcome> outcomes;
    for (std::uint32_t k = 0; k < 3; ++k)
      outcomes.push_back(
          {0.3, draws.uniform(-1, 1, i, k), draws.bits(i, 3 + k) % states});
    outcomes.push_back({0.1, 0, std::nullopt});
    world.outcomes.push_back(outcomes);
  }
  return world;
}

mdp_outcome drawn(const std::vector<mdp_outcome>& outcomes, double draw) {
  for (const auto& outcome : outcomes)
    if ((draw -= outcome.probability) < 0)
      return outcome;
  return outcomes.back();
}

} // namespace

TEST_CASE("value iteration finds the values of a process solved by hand") {
  // Wait for 1, or take 3 and end; waiting for ever is worth 1 / (1 − γ).
  const finite_mdp world{2, {{{1, 1, 0}}, {{1, 3, std::nullopt}}}};
  const auto patient = value_iteration(world, 0.75, 1e-12);
  CHECK(patient[0] == doctest::Approx(4));
  CHECK(patient[1] == 3);
  const auto hasty = value_iteration(world, 0.5, 1e-12);
  CHECK(hasty[0] == doctest::Approx(1 + 0.5 * 3));
}

TEST_CASE("value iteration does not take what is not allowed") {
  const finite_mdp world{2, {{{1, 2, 1}}, {}, {{1, 1, std::nullopt}}, {}}};
  const auto values = value_iteration(world, 0.5, 1e-12);
  CHECK(values[0] == 2.5);
  CHECK(values[1] == -std::numeric_limits<double>::infinity());
}

TEST_CASE("tabular Q-learning comes close to value iteration") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto world = random_world(seed);
    const auto exact = value_iteration(world, discount, 1e-12);
    q_learning_options options{states, actions, discount};
    options.explore = {1, 1};
    q_learning learner{options, random_stream{seed, "learner"}};
    const random_stream chance{seed, "chance"};
    std::size_t state = 0;
    for (std::uint64_t step = 0; step < 200'000; ++step) {
      const auto any = first_actions(actions);
      const auto action = *learner.choose(state, any);
      const auto outcome =
          drawn(world.outcomes[state * actions + action], chance.uniform(step));
      learner.learn({state, action, outcome.reward, outcome.next, any});
      state = outcome.next.value_or(chance.bits(step, 1) % states);
    }
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const auto learned = learner.values(i / actions)[i % actions];
      worst = std::max(worst, std::abs(learned - exact[i]));
    }
    CHECK(worst < 0.1);
  }
}
