// Tests of trying what is not held for the best.
#include "policies/algorithms/learning/exploration.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

using namespace sofof;
using namespace sofof::policies;

namespace {

constexpr std::array values{1.0, 4.0, 2.0, 3.0};
const random_stream exploration_draws{1, "exploration"};

} // namespace

TEST_CASE("the best action is the first of those that are worth most") {
  CHECK(best_action(values, first_actions(4)) == 1);
  CHECK(best_action(std::array{2.0, 5.0, 5.0}, first_actions(3)) == 1);
  CHECK(best_action(values, action_set{0b1101}) == 3);
}

TEST_CASE("where nothing is allowed, nothing is chosen") {
  CHECK(!best_action(values, {}));
  CHECK(!explore_or_best(values, {}, 0, exploration_draws, 1));
  CHECK(!explore_or_best(values, {}, 1, exploration_draws, 1));
}

TEST_CASE("an action that is not allowed is never chosen") {
  for (std::uint64_t allowed = 1; allowed < 16; ++allowed)
    for (std::uint64_t decision = 0; decision < 200; ++decision) {
      const auto chosen = explore_or_best(values, action_set{allowed}, 0.5,
                                          exploration_draws, decision);
      REQUIRE(chosen);
      CHECK(action_set{allowed}[*chosen]);
    }
}

TEST_CASE("an allowed action that does not exist is never chosen") {
  for (std::uint64_t decision = 0; decision < 200; ++decision)
    CHECK(*explore_or_best(values, action_set{}.set(), 1, exploration_draws,
                           decision)
          < 4);
}

TEST_CASE("values that are no numbers do not lead to what is not allowed") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(best_action(std::array{nan, nan, nan}, action_set{0b110}) == 1);
}

TEST_CASE("exploring, all allowed actions are as likely") {
  std::array<int, 4> chosen{};
  for (std::uint64_t decision = 0; decision < 3000; ++decision)
    ++chosen[*explore_or_best(values, action_set{0b1101}, 1, exploration_draws,
                              decision)];
  for (const auto action : {0, 2, 3}) {
    CHECK(chosen[static_cast<std::size_t>(action)] > 900);
    CHECK(chosen[static_cast<std::size_t>(action)] < 1100);
  }
}

TEST_CASE("the share of random decisions falls in a straight line") {
  const exploration explore{1, 0.2, 1000};
  CHECK(explore.share(0) == 1);
  CHECK(explore.share(500) == doctest::Approx(0.6));
  CHECK(explore.share(1000) == doctest::Approx(0.2));
  CHECK(explore.share(1'000'000) == doctest::Approx(0.2));
}
