// Regret of UCB1 on five Bernoulli arms. The numbers 84 and 233 were measured
// with a prototype of the algorithm in Auer, Cesa-Bianchi & Fischer 2002.
#include "base/random.hpp"
#include "policies/algorithms/learning/ucb1.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace sofof;
using namespace sofof::policies;

namespace {

constexpr std::array means{0.9, 0.8, 0.7, 0.6, 0.5};
constexpr int seeds = 200;

struct regrets {
  double early = 0; // after 1 000 pulls
  double late = 0;  // after 10 000 pulls
};

regrets mean_regrets() {
  regrets mean;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const random_stream draws{seed, "arms"};
    ucb1 bandit{means.size()};
    double regret = 0;
    for (std::uint64_t pull = 1; pull <= 10'000; ++pull) {
      const auto arm = *bandit.choose(first_actions(means.size()));
      const auto lane = static_cast<std::uint32_t>(arm);
      bandit.learn(arm, draws.uniform(pull, lane) < means[arm] ? 1 : 0);
      regret += means[0] - means[arm];
      if (pull == 1000)
        mean.early += regret / seeds;
    }
    mean.late += regret / seeds;
  }
  return mean;
}

double auers_bound(double pulls) {
  double bound = 0;
  for (std::size_t arm = 1; arm < means.size(); ++arm) {
    const auto gap = means[0] - means[arm];
    bound += 8 * std::log(pulls) / gap
             + (1 + std::numbers::pi * std::numbers::pi / 3) * gap;
  }
  return bound;
}

} // namespace

TEST_CASE("UCB1's regret is that of the prototype, and below Auer's bound") {
  const auto [early, late] = mean_regrets();
  CHECK(early == test::near(84, 0.05));
  CHECK(late == test::near(233, 0.05));
  CHECK(auers_bound(1e3) == test::near(1156, 0.001));
  CHECK(auers_bound(1e4) == test::near(1539, 0.001));
  CHECK(early < auers_bound(1e3));
  CHECK(late < auers_bound(1e4));
}
