// Tests of learning from a table.
#include "policies/algorithms/learning/q_learning.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::policies;

namespace {

const random_stream q_draws{1, "learner"};
const auto both = first_actions(2);

} // namespace

TEST_CASE("a value moves by its rate to the reward and the next best value") {
  q_learning learner{{3, 2, 0.5, 0.25}, q_draws};
  learner.learn({1, 0, 8, std::nullopt, {}});
  CHECK(learner.values(1)[0] == 2);
  learner.learn({0, 1, 1, 1, both});
  CHECK(learner.values(0)[1] == 0.25 * (1 + 0.5 * 2));
}

TEST_CASE("with the falling rate the first sample counts whole, and later "
          "ones less and less") {
  q_learning learner{{1, 2}, q_draws};
  learner.learn({0, 0, 4, std::nullopt, {}});
  CHECK(learner.values(0)[0] == 4);
  learner.learn({0, 0, 0, std::nullopt, {}});
  CHECK(learner.values(0)[0] == doctest::Approx(4 * (1 - std::pow(2, -0.7))));
}

TEST_CASE("what is not allowed next is not hoped for") {
  q_learning learner{{2, 2, 1, 1}, q_draws};
  learner.learn({1, 0, 5, std::nullopt, {}});
  learner.learn({1, 1, 3, std::nullopt, {}});
  learner.learn({0, 0, 0, 1, action_set{0b10}});
  CHECK(learner.values(0)[0] == 3);
  learner.learn({0, 0, 0, 1, {}});
  CHECK(learner.values(0)[0] == 0);
}

TEST_CASE("a table never chooses what is not allowed") {
  q_learning learner{{2, 2, 0.9, 0.5, {0.5, 0.5}}, q_draws};
  learner.learn({0, 0, 9, std::nullopt, {}});
  for (int k = 0; k < 200; ++k)
    CHECK(learner.choose(0, action_set{0b10}) == 1);
  CHECK(learner.best(0, both) == 0);
  CHECK(learner.best(0, action_set{0b10}) == 1);
  CHECK(!learner.choose(0, {}));
}
