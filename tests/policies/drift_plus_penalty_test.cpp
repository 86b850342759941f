// Tests of the least energy with a budget of violations.
#include "policies/algorithms/lyapunov/drift_plus_penalty.hpp"

#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

using namespace sofof;
using namespace sofof::policies;
using test::dice;
using test::near;

namespace {

constexpr planning_option local{.energy_j = 1};

} // namespace

TEST_CASE("without debts the least energy wins, the first of equals") {
  const drift_plus_penalty policy;
  const std::array choices{local, planning_option{0.4, 0.5},
                           planning_option{0.4, 0.1}};
  CHECK(policy.choose(choices) == 1);
}

TEST_CASE("a debt of violations turns the choice to what misses less, then to "
          "local") {
  drift_plus_penalty policy{{.energy_weight = 1, .violation_budget = 0}};
  const std::array choices{local, planning_option{0.4, 0.5},
                           planning_option{0.45, 0.1}};
  CHECK(policy.choose(choices) == 1);
  policy.observe({.missed = true});
  CHECK(policy.choose(choices) == 2);
  for (int k = 0; k < 5; ++k) // 0.45 + 6 · 0.1 > 1
    policy.observe({.missed = true});
  CHECK(policy.choose(choices) == 0);
}

TEST_CASE("a debt of energy weighs like V") {
  drift_plus_penalty policy{{.energy_weight = 0, .energy_budget_j = 0.5}};
  CHECK(policy.choose(std::array{local, planning_option{0.4}}) == 0);
  policy.observe({.energy_j = 1});
  CHECK(policy.energy_debt_j() == 0.5);
  CHECK(policy.choose(std::array{local, planning_option{0.4}}) == 1);
  policy.observe({.energy_j = 0.1});
  CHECK(policy.energy_debt_j() == near(0.1, 1e-12));
}

TEST_CASE("a backlog turns the choice to what serves more") {
  drift_plus_penalty policy{{.energy_weight = 1}};
  const std::array choices{planning_option{.energy_j = 0.4, .served = 1},
                           planning_option{.energy_j = 1, .served = 2}};
  CHECK(policy.choose(choices) == 0);
  policy.observe({.served = 0, .arrived = 1});
  CHECK(policy.backlog() == 1);
  CHECK(policy.choose(choices) == 1);
  policy.observe({.served = 3, .arrived = 0});
  CHECK(policy.backlog() == 0);
}

TEST_CASE("an option whose price is no number is not chosen") {
  const drift_plus_penalty policy;
  const auto unknown = std::numeric_limits<double>::quiet_NaN();
  CHECK(policy.choose(std::array{planning_option{unknown}, local}) == 1);
  CHECK(policy.choose(std::array{planning_option{unknown}}) == 0);
}

// Halves and sixteenths add up without rounding, so this holds to the last bit.
TEST_CASE("missed cycles stay within budget plus debt on every run, however "
          "wrong the forecasts are") {
  dice random{4};
  for (int run = 0; run < 100; ++run) {
    drift_plus_penalty policy{{.energy_weight = random.between(0, 200),
                               .violation_budget = 1.0 / 16,
                               .energy_budget_j = 0.5}};
    const auto truth = random.between(0, 1);
    double missed = 0;
    double energy_j = 0;
    for (int t = 1; t <= 500; ++t) {
      const std::array choices{local,
                               planning_option{0.5, random.between(0, 1)}};
      const auto choice = policy.choose(choices);
      const auto misses = choice > 0 && random.between(0, 1) < truth;
      policy.observe({.missed = misses, .energy_j = choices[choice].energy_j});
      missed += misses ? 1 : 0;
      energy_j += choices[choice].energy_j;
      REQUIRE(missed <= t / 16.0 + policy.violation_debt());
      REQUIRE(energy_j <= t / 2.0 + policy.energy_debt_j());
    }
  }
}
