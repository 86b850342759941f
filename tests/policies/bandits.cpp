// Tests of learning which provider is good by trying them.
#include "base/random.hpp"
#include "policies/algorithms/learning/alto.hpp"
#include "policies/algorithms/learning/ucb1.hpp"

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <vector>

using namespace sofof;
using namespace sofof::policies;

TEST_CASE("UCB1 tries every allowed arm once, in order") {
  ucb1 bandit{4};
  const action_set allowed{0b1011};
  for (const std::size_t arm : {0, 1, 3}) {
    CHECK(bandit.choose(allowed) == arm);
    bandit.learn(arm, 0.5);
  }
}

TEST_CASE("UCB1 adds to a mean what its few pulls may hide") {
  ucb1 bandit{2};
  for (int k = 0; k < 9; ++k)
    bandit.learn(0, 0.6);
  bandit.learn(1, 0.1);
  // 0.6 + √(2 ln 10 / 9) = 1.32 against 0.1 + √(2 ln 10) = 2.25.
  CHECK(bandit.choose(first_actions(2)) == 1);
  for (int k = 0; k < 4; ++k)
    bandit.learn(1, 0.1);
  // 0.6 + √(2 ln 14 / 9) = 1.37 against 0.1 + √(2 ln 14 / 5) = 1.13.
  CHECK(bandit.choose(first_actions(2)) == 0);
}

TEST_CASE("UCB1 never chooses an arm that is not allowed") {
  ucb1 bandit{3};
  CHECK(!bandit.choose({}));
  const random_stream draws{1, "arms"};
  for (std::uint64_t pull = 0; pull < 500; ++pull) {
    const action_set allowed{1 + draws.bits(pull) % 7};
    const auto arm = bandit.choose(allowed);
    REQUIRE(arm);
    CHECK(allowed[*arm]);
    bandit.learn(*arm, draws.uniform(pull, 1));
  }
}

namespace {

constexpr double small = 80e3;
constexpr double large = 320e3;
constexpr double worst_s_per_bit = 0.050 / 160e3;

// What happens when providers answer with random delays around their means,
// given in parts of the worst.
class neighbourhood {
public:
  explicit neighbourhood(std::uint64_t seed) : draws_{seed, "delays"} {}

  std::map<provider_id, double> means;
  std::map<provider_id, int> chosen;

  void offload(alto& bandit, int tasks, double task_bits) {
    for (int k = 0; k < tasks; ++k) {
      std::vector<provider_id> present;
      for (const auto& [provider, mean] : means)
        present.push_back(provider);
      const auto provider = *bandit.choose(task_bits, present);
      ++chosen[provider];
      const auto part = means[provider] + draws_.uniform(-0.2, 0.2, ++drawn_);
      bandit.learn(provider, task_bits, part * worst_s_per_bit * task_bits);
    }
  }

private:
  random_stream draws_;
  std::uint64_t drawn_ = 0;
};

} // namespace

TEST_CASE("ALTO finds the quickest provider") {
  alto bandit{{}};
  neighbourhood around{1};
  around.means = {{7, 0.5}, {8, 0.3}, {9, 0.7}};
  around.offload(bandit, 1000, small);
  CHECK(around.chosen[8] > 850);
}

TEST_CASE("ALTO explores less when tasks are large") {
  std::array<int, 3> others{};
  const std::array sizes{small, 0.5 * (small + large), large};
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    alto bandit{{}};
    neighbourhood around{1};
    around.means = {{7, 0.5}, {8, 0.3}, {9, 0.7}};
    around.offload(bandit, 1000, sizes[k]);
    others[k] = around.chosen[7] + around.chosen[9];
  }
  CHECK(others[0] > others[1]);
  CHECK(others[1] > others[2]);
  CHECK(others[2] == 2); // each once
}

TEST_CASE("ALTO explores with small tasks what it uses for large ones") {
  alto bandit{{}};
  neighbourhood around{2};
  around.means = {{7, 0.5}, {8, 0.3}};
  around.offload(bandit, 2, small);
  for (int k = 0; k < 300; ++k) {
    around.offload(bandit, 1, small);
    neighbourhood large_tasks{static_cast<std::uint64_t>(k)};
    large_tasks.means = around.means;
    large_tasks.offload(bandit, 1, large);
    if (k >= 50)
      CHECK(large_tasks.chosen[8] == 1);
  }
  CHECK(around.chosen[7] > 5);
}

TEST_CASE("ALTO gives a provider that appears late a clock of its own") {
  // Two that are alike, one of which appears after 10 000 tasks. Heard of once
  // each, the one that was there has the wider doubt: ln 10 002 against ln 1.
  alto bandit{{}};
  constexpr provider_id newcomer = 1;
  constexpr provider_id old_one = 2;
  const std::array both{newcomer, old_one};
  for (int k = 0; k < 10'000; ++k)
    bandit.choose(small, std::array{old_one});
  bandit.learn(old_one, small, 0.5 * worst_s_per_bit * small);
  CHECK(bandit.choose(small, both) == newcomer); // never heard of
  bandit.learn(newcomer, small, 0.5 * worst_s_per_bit * small);
  CHECK(bandit.choose(small, both) == old_one);
}

TEST_CASE("ALTO tries a provider that comes and is better") {
  alto bandit{{}};
  neighbourhood around{3};
  around.means = {{7, 0.5}, {8, 0.4}};
  around.offload(bandit, 2000, small);
  around.means[9] = 0.2;
  around.chosen.clear();
  around.offload(bandit, 1000, small);
  CHECK(around.chosen[9] > 800);
}

TEST_CASE("ALTO chooses among those present only") {
  alto bandit{{}};
  CHECK(!bandit.choose(small, {}));
  bandit.learn(5, small, 0.01); // nobody knows it
  CHECK(bandit.choose(small, std::array{provider_id{9}, provider_id{4}})
        == provider_id{4});
  bandit.learn(4, small, 0.001);
  CHECK(bandit.choose(small, std::array{provider_id{9}}) == provider_id{9});
}

TEST_CASE("to ALTO a loss is no worse than the worst delay") {
  alto lost{{}};
  alto late{{}};
  for (auto* bandit : {&lost, &late})
    bandit->choose(small, std::array{provider_id{1}});
  lost.learn(1, small, 1e9);
  late.learn(1, small, worst_s_per_bit * small);
  CHECK(lost.snapshot() == late.snapshot());
}
