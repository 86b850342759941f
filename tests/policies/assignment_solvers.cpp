// Tests of solvers against each other and against trying everything.
#include "policies/algorithms/assignment/branch_and_bound.hpp"
#include "policies/algorithms/assignment/cbc.hpp"
#include "policies/algorithms/assignment/greedy_regret.hpp"
#include "policies/algorithms/assignment/lagrangian_bound.hpp"
#include "policies/algorithms/assignment/min_cost_flow.hpp"
#include "policies/algorithms/assignment/sampled.hpp"
#include "tests/support/assignments.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sofof::policies::assignment {

using test::any_problem;
using test::below;
using test::best_by_trying;
using test::dice;
using test::open_problem;
using test::place_at_random;
using test::scarce;
using test::table_between;

namespace {

constexpr double rounding = 1e-8;

/// Vehicles that all want the same, which differs among providers.
problem equal_demands(dice& random, int vehicles, int providers) {
  auto p = open_problem(vehicles, providers);
  p.gains = table_between(random, vehicles, providers, -0.3, 1);
  p.eligible = table_between(random, vehicles, providers, 0, 1) < 0.8;
  p.switching_price = 0.05;
  place_at_random(p, random);
  const auto demand = table_between(random, 1, providers, 0.1, 0.2);
  p.resources.push_back(
      {demand.replicate(vehicles, 1), std::vector<double>(providers, 0.55)});
  return p;
}

problem scarce_problem(dice& random, int vehicles, int providers) {
  auto p = open_problem(vehicles, providers);
  p.gains = table_between(random, vehicles, providers, 0.1, 1);
  p.switching_price = 0.05;
  place_at_random(p, random);
  p.resources.push_back(scarce(random, vehicles, providers, 0.6));
  return p;
}

double all_local(const problem& p) {
  return value(p, std::vector<choice>(p.vehicles(), local));
}

/// Some vehicles lean on others with a lower or a higher index.
void lean_at_random(problem& p, dice& random) {
  p.leans_on.resize(static_cast<std::size_t>(p.vehicles()));
  p.lost_alone = table_between(random, p.vehicles(), p.providers(), 0, 1);
  const auto up = below(random, 2) == 0;
  for (int v = 1; v < p.vehicles(); ++v)
    if (below(random, 2) == 0)
      p.leans_on[up ? v : p.vehicles() - 1 - v] = up ? v - 1 : p.vehicles() - v;
}

/// The objective of choices, as its formula is written.
double sum_leaning(const problem& p, const std::vector<choice>& choices) {
  double sum = 0;
  for (int v = 0; v < p.vehicles(); ++v) {
    const auto c = choices[v];
    sum += test::objective(p, v, c);
    if (const auto on = p.leans_on[v]; c && on && choices[*on] != c)
      sum -= p.lost_alone(v, *c);
  }
  return sum;
}

/// @returns the greatest objective of choices from one vehicle on; tries all.
double best_leaning(const problem& p, std::vector<choice>& choices, int from) {
  if (from == p.vehicles())
    return feasible(p, choices) ? sum_leaning(p, choices) : -1e9;
  choices[from] = local;
  auto best = best_leaning(p, choices, from + 1);
  for (int i = 0; i < p.providers(); ++i)
    if (p.eligible(from, i)) {
      choices[from] = i;
      best = std::max(best, best_leaning(p, choices, from + 1));
    }
  choices[from] = local;
  return best;
}

} // namespace

TEST_CASE("branch and bound finds what trying everything finds") {
  dice random{1};
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    auto p = any_problem(random);
    const auto found = branch_and_bound(p);
    CHECK(found.proved);
    CHECK(feasible(p, found.best.choices));
    CHECK(found.best.value == value(p, found.best.choices));
    CHECK(std::abs(found.best.value - best_by_trying(p)) < rounding);
  }
}

TEST_CASE("where vehicles lean on others, branch and bound finds what trying "
          "everything finds, and all others what is possible") {
  dice random{31};
  int flows = 0;
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    auto p = any_problem(random);
    if (p.vehicles() > 6)
      continue;
    p.gains -= 0.3;
    lean_at_random(p, random);
    std::vector<choice> choices(p.vehicles());
    const auto best = best_leaning(p, choices, 0);
    const auto found = branch_and_bound(p);
    CHECK(found.proved);
    CHECK(feasible(p, found.best.choices));
    CHECK(std::abs(found.best.value - best) < rounding);
    CHECK(std::abs(sum_leaning(p, found.best.choices) - best) < rounding);
    for (const auto& one :
         {greedy_regret(p), sampled(p, {}, random_stream{1, "leaning"})}) {
      CHECK(feasible(p, one.choices));
      CHECK(std::abs(one.value - sum_leaning(p, one.choices)) < rounding);
      CHECK(one.value >= all_local(p) - rounding);
      CHECK(one.value <= best + rounding);
    }
    if (const auto flow = min_cost_flow(p)) {
      ++flows;
      CHECK(std::abs(flow->value - best) < rounding);
    }
  }
  CHECK(flows > 0);
}

TEST_CASE("who leans in a circle, or on nobody there is, or wins by being "
          "alone, is refused") {
  auto p = open_problem(2, 1);
  p.lost_alone = pair_table::Zero(2, 1);
  p.leans_on = {1, 0};
  CHECK_THROWS_AS(check(p), std::invalid_argument);
  p.leans_on = {std::nullopt, 2};
  CHECK_THROWS_AS(check(p), std::invalid_argument);
  p.leans_on = {std::nullopt};
  CHECK_THROWS_AS(check(p), std::invalid_argument);
  p.leans_on = {std::nullopt, 0};
  check(p);
  p.lost_alone(1, 0) = -0.1;
  CHECK_THROWS_AS(check(p), std::invalid_argument);
}

#ifdef SOFOF_WITH_CBC
TEST_CASE("CBC finds what branch and bound proves, and where that gives up no "
          "less, and no more than it bounds") {
  dice random{11};
  int given_up = 0;
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    auto p = k < 90 ? any_problem(random) : scarce_problem(random, 40, 3);
    if (k >= 90)
      p.resources.push_back(scarce(random, 40, 3, 0.6));
    const auto found = cbc(p);
    const auto proved = branch_and_bound(p);
    given_up += !proved.proved;
    REQUIRE(found);
    CHECK(feasible(p, found->choices));
    CHECK(found->value > proved.best.value - 1e-6);
    CHECK(found->value < proved.bound + 1e-6);
  }
  CHECK(given_up > 0);
}
#endif

TEST_CASE("the greedy assignment is feasible, between all local and the "
          "optimum") {
  dice random{2};
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const auto p = any_problem(random);
    const auto found = greedy_regret(p);
    CHECK(feasible(p, found.choices));
    CHECK(found.value == value(p, found.choices));
    CHECK(found.value >= all_local(p));
    CHECK(found.value <= branch_and_bound(p).best.value + rounding);
  }
}

TEST_CASE("the greedy assignment comes within 5 % of the optimum where 60 % "
          "find room") {
  dice random{3};
  for (int k = 0; k < 20; ++k) {
    const auto p = scarce_problem(random, 20, 3);
    CHECK(greedy_regret(p).value > 0.95 * branch_and_bound(p).best.value);
  }
}

TEST_CASE("min-cost flow finds the optimum where demands are equal") {
  dice random{4};
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const auto p =
        equal_demands(random, 1 + below(random, 20), 1 + below(random, 4));
    const auto found = min_cost_flow(p);
    const auto proved = branch_and_bound(p);
    REQUIRE(found);
    REQUIRE(proved.proved);
    CHECK(feasible(p, found->choices));
    CHECK(found->value == value(p, found->choices));
    CHECK(std::abs(found->value - proved.best.value) < rounding);
  }
}

TEST_CASE("min-cost flow is not for demands that differ") {
  auto p = open_problem(2, 1);
  p.gains.setConstant(1);
  p.resources.push_back({pair_table::Constant(2, 1, 0.5), {1}});
  CHECK(min_cost_flow(p));
  p.resources.front().demand(1, 0) = 0.25;
  CHECK_FALSE(min_cost_flow(p));
  p.eligible(1, 0) = false;
  CHECK(min_cost_flow(p));
}

TEST_CASE("what the cross-entropy method finds is feasible, between all local "
          "and the optimum") {
  dice random{5};
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    const auto p = any_problem(random);
    const auto found =
        sampled(p, {.iterations = 10}, random_stream{7, "samples"}.part(k));
    CHECK(feasible(p, found.choices));
    CHECK(found.value == value(p, found.choices));
    CHECK(found.value >= all_local(p));
    CHECK(found.value <= branch_and_bound(p).best.value + rounding);
  }
}

TEST_CASE(
    "the cross-entropy method comes within 10 % of the optimum where 60 % "
    "find room, in the mean") {
  dice random{6};
  double sum = 0;
  for (int k = 0; k < 5; ++k) {
    const auto p = scarce_problem(random, 20, 3);
    sum += sampled(p, {}, random_stream{1, "samples"}).value
           / branch_and_bound(p).best.value;
  }
  CHECK(sum / 5 > 0.9);
}

TEST_CASE("without resources everybody takes the best offer") {
  auto p = open_problem(3, 2);
  p.gains << 0.1, 0.2, -0.1, -0.2, 0.4, 0.3;
  const std::vector<choice> expected{1, local, 0};
  const auto proved = branch_and_bound(p);
  CHECK(proved.best.choices == expected);
  CHECK(proved.nodes <= 1);
  CHECK(greedy_regret(p).choices == expected);
  CHECK(min_cost_flow(p).value().choices == expected);
  CHECK(sampled(p, {}, random_stream{1, "samples"}).choices == expected);
}

TEST_CASE("nobody, or nobody to serve, is an assignment too") {
  for (const auto& p :
       {open_problem(0, 0), open_problem(0, 2), open_problem(2, 0)}) {
    const std::vector<choice> expected(p.vehicles(), local);
    CHECK(branch_and_bound(p).best.choices == expected);
    CHECK(branch_and_bound(p).proved);
    CHECK(greedy_regret(p).choices == expected);
    CHECK(min_cost_flow(p).value().choices == expected);
    CHECK(sampled(p, {}, random_stream{1, "samples"}).choices == expected);
  }
}

TEST_CASE("a search that may look at nothing returns the greedy assignment, "
          "unproved") {
  dice random{1};
  const auto p = scarce_problem(random, 20, 3);
  const auto found = branch_and_bound(p, 0);
  const auto all = branch_and_bound(p);
  const auto optimum = all.best.value;
  CHECK(all.proved);
  CHECK(all.bound == optimum);
  CHECK_FALSE(found.proved);
  CHECK(found.nodes == 0);
  CHECK(found.best.choices == greedy_regret(p).choices);
  CHECK(found.best.value < optimum);
  CHECK(found.bound > optimum);
}

TEST_CASE("a longer search is never worse, and its bound holds") {
  dice random{9};
  const auto p = scarce_problem(random, 20, 3);
  const auto optimum = branch_and_bound(p).best.value;
  double before = all_local(p);
  for (const int limit : {0, 10, 100, 1000, 10'000, 100'000}) {
    const auto found = branch_and_bound(p, limit);
    CHECK(found.nodes <= limit);
    CHECK(found.best.value >= before);
    CHECK(found.bound >= optimum);
    before = found.best.value;
  }
  CHECK(before == optimum);
}

TEST_CASE("prices of capacities bound every optimum from above, and closely "
          "where many share") {
  dice random{10};
  for (int k = 0; k < 100; ++k) {
    const auto p = any_problem(random);
    const auto s = stakes_of(p);
    const auto reached = branch_and_bound(p).best.value - s.all_local;
    CHECK(price_capacities(s, 0).bound >= reached - rounding);
  }
  const auto p = scarce_problem(random, 40, 3);
  const auto s = stakes_of(p);
  const auto reached = branch_and_bound(p).best.value - s.all_local;
  CHECK(price_capacities(s, 0).bound < 1.03 * reached);
}

TEST_CASE("a high switching price keeps everybody where they are") {
  dice random{11};
  auto p = scarce_problem(random, 10, 2);
  p.present = branch_and_bound(p).best.choices;
  p.gains = table_between(random, 10, 2, 0.1, 1);
  const auto present = p.present;
  p.switching_price = 0;
  CHECK(branch_and_bound(p).best.choices != present);
  p.switching_price = 10;
  CHECK(branch_and_bound(p).best.choices == present);
}

} // namespace sofof::policies::assignment
