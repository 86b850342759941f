// Tests of taking what a learner knows to another one, as text.
#include "policies/algorithms/learning/alto.hpp"
#include "policies/algorithms/learning/dqn.hpp"
#include "policies/algorithms/learning/q_learning.hpp"
#include "policies/algorithms/learning/state_text.hpp"
#include "policies/algorithms/learning/ucb1.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

using namespace sofof;
using namespace sofof::policies;

namespace {

const auto any_action = first_actions(3);
const random_stream learner_draws{1, "learner"};
const random_stream chance{1, "chance"};

// Each learner with a way to make it decide and learn once, by the number of
// the step; it returns what was decided.
struct ucb1_learner {
  ucb1 learner{3};

  std::uint64_t live(std::uint64_t step) {
    const auto arm = *learner.choose(any_action);
    learner.learn(arm, chance.uniform(step));
    return arm;
  }
};

struct alto_learner {
  alto learner{{}};

  std::uint64_t live(std::uint64_t step) {
    std::array<provider_id, 3> present{1, provider_at(2, 1'700'000'000'000),
                                       3 + step / 20};
    const auto bits = chance.uniform(50e3, 400e3, step, 1);
    const auto provider = *learner.choose(bits, present);
    learner.learn(provider, bits, chance.exponential(0.02, step));
    return provider.value();
  }
};

struct q_learner {
  q_learning learner{options(), learner_draws};

  static q_learning_options options() {
    q_learning_options options{4, 3};
    options.explore = {0.5, 0.01, 100};
    return options;
  }

  std::uint64_t live(std::uint64_t step) {
    const auto action = *learner.choose(step % 4, any_action);
    learner.learn({step % 4, action, chance.normal(0, 1, step), (step + 1) % 4,
                   any_action});
    return action;
  }
};

// Only decides after the first 50 steps: its memory does not travel.
struct dqn_learner {
  dqn learner{options(), learner_draws};

  static dqn_options options() {
    dqn_options options{{2, 3, 4}};
    options.batch = 8;
    options.explore = {0.5, 0.01, 100};
    return options;
  }

  std::uint64_t live(std::uint64_t step) {
    const std::array here{chance.normal(0, 1, step), 1.0};
    const std::array there{chance.normal(0, 1, step + 1), 1.0};
    const auto action = *learner.choose(here, any_action);
    if (step < 50)
      learner.learn(
          {here, action, chance.normal(0, 1, step, 1), there, any_action});
    return action;
  }
};

template <class Learner>
std::string snapshot_after(std::uint64_t steps) {
  Learner one;
  for (std::uint64_t step = 0; step < steps; ++step)
    one.live(step);
  return one.learner.snapshot();
}

std::string mutated(std::string text, test::dice& random) {
  constexpr std::string_view alphabet = "0123456789.-+einfa x\n";
  const auto place = [&] {
    return static_cast<std::size_t>(
        random.between(0, static_cast<double>(text.size())));
  };
  const auto symbol = alphabet[static_cast<std::size_t>(
      random.between(0, static_cast<double>(alphabet.size())))];
  const auto at = place();
  switch (static_cast<int>(random.between(0, 6))) {
    case 0:
      text[at] = symbol;
      break;
    case 1:
      text.insert(at, 1, symbol);
      break;
    case 2:
      text.erase(at, 1);
      break;
    case 3:
      text.resize(at);
      break;
    case 4:
      text.insert(at, text.substr(place(), 8));
      break;
    default:
      text[at] = static_cast<char>(random.between(-128, 128));
  }
  return text;
}

} // namespace

#define LEARNERS ucb1_learner, alto_learner, q_learner, dqn_learner

TEST_CASE_TEMPLATE("a restored learner goes on as the one it was taken from",
                   learner, LEARNERS) {
  learner one;
  for (std::uint64_t step = 0; step < 60; ++step)
    one.live(step);
  learner other;
  REQUIRE(!other.learner.restore(one.learner.snapshot()));
  CHECK(other.learner.snapshot() == one.learner.snapshot());
  for (std::uint64_t step = 60; step < 160; ++step)
    CHECK(other.live(step) == one.live(step));
  CHECK(other.learner.snapshot() == one.learner.snapshot());
}

TEST_CASE_TEMPLATE("what another learner has written is refused", learner,
                   LEARNERS) {
  for (const auto& text :
       {snapshot_after<ucb1_learner>(60), snapshot_after<alto_learner>(60),
        snapshot_after<q_learner>(60), snapshot_after<dqn_learner>(60)})
    CHECK(learner{}.learner.restore(text).has_value()
          == (text != snapshot_after<learner>(60)));
}

TEST_CASE_TEMPLATE("a snapshot that lacks anything or has more is refused",
                   learner, LEARNERS) {
  const auto text = snapshot_after<learner>(60);
  for (std::size_t length = 0; length + 1 < text.size(); ++length)
    CHECK(learner{}.learner.restore(text.substr(0, length)));
  CHECK(learner{}.learner.restore(text + "1"));
  CHECK(!learner{}.learner.restore(text + " \n "));
}

TEST_CASE_TEMPLATE("a spoilt snapshot is refused and changes nothing, or is "
                   "the snapshot of a learner that can go on",
                   learner, LEARNERS) {
  const auto text = snapshot_after<learner>(60);
  test::dice random{7};
  int refused = 0;
  for (int k = 0; k < 5000; ++k) {
    auto spoilt = mutated(text, random);
    if (k % 3 == 0)
      spoilt = mutated(spoilt, random);
    learner one;
    const auto before = one.learner.snapshot();
    if (const auto reason = one.learner.restore(spoilt)) {
      ++refused;
      CHECK(reason->starts_with("line "));
      CHECK(one.learner.snapshot() == before);
      continue;
    }
    const auto taken = one.learner.snapshot();
    learner other;
    REQUIRE(!other.learner.restore(taken));
    CHECK(other.learner.snapshot() == taken);
    CHECK(other.live(50) == one.live(50));
  }
  CHECK(refused > 1500);
}

TEST_CASE("a refusal says what is wrong and where") {
  ucb1 bandit{2};
  CHECK(*bandit.restore("sofof ucb1 2 arms 2")
        == "line 1, word 3: expected ucb1 1, found 2.");
  CHECK(*bandit.restore("sofof ucb1 1 arms 3")
        == "line 1, word 5: expected arms 2, found 3.");
  CHECK(*bandit.restore("sofof ucb1 1 arms 2 0.5 1 x 1")
        == "line 1, word 8: expected a number, found \"x\".");
  CHECK(*bandit.restore("sofof ucb1 1 arms 2 0.5 1 inf 1")
        == "line 1, word 8: expected a finite number.");
  CHECK(*bandit.restore("sofof ucb1 1 arms 2 0.5 1 2 1")
        == "line 1, word 9: expected rewards from 0 to 1.");
  CHECK(*bandit.restore("")
        == "line 1, word 1: expected \"sofof\", found \"\".");
}

TEST_CASE("ALTO's providers appear once, and not in the future") {
  const std::string head = "sofof alto 1 worst 1e-6 tasks 9 providers ";
  alto_options options;
  options.worst_delay_s_per_bit = 1e-6;
  alto bandit{options};
  CHECK(!bandit.restore(head + "2 5 1 1 .5 6 9 0 0 end"));
  CHECK(bandit.restore(head + "2 5 1 1 .5 5 9 0 0 end"));
  CHECK(bandit.restore(head + "1 5 10 1 .5 end"));
  CHECK(bandit.restore(head + "1 5 1 1 1.5 end"));
  CHECK(bandit.restore(head + "9007199254740992 end"));
}

TEST_CASE("ALTO refuses delays in parts of another worst one") {
  alto_options options;
  options.worst_delay_s_per_bit = 1e-6;
  CHECK(*alto{options}.restore(alto{{}}.snapshot())
        == "line 1, word 5: expected the worst delay of this learner.");
}

TEST_CASE("every double reads back to the bit") {
  test::dice random{8};
  const auto same = [](double number) {
    state_writer out{"numbers", 1};
    const auto text = out.number(number).text();
    state_reader in{text, "numbers", 1};
    const auto read = in.number();
    in.expect_end();
    return !in.failed()
           && std::bit_cast<std::uint64_t>(read)
                  == std::bit_cast<std::uint64_t>(number);
  };
  using limits = std::numeric_limits<double>;
  for (const auto number : {0.0, -0.0, 0.1, limits::denorm_min(), limits::max(),
                            limits::lowest(), limits::min()})
    CHECK(same(number));
  for (int k = 0; k < 2000; ++k)
    CHECK(
        same(random.between(-1, 1) * std::pow(10, random.between(-300, 300))));
}
