// The order of cars over a crossing: by hand, and against all orders.
#include "planners/crossing/order_search.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

order_problem::car arrives(double at_s, std::size_t lane) {
  return {lane, at_s, at_s, {}};
}

/// Lags of those that meet, both ways.
void meet(order_problem& p, std::size_t a, std::size_t b, double lag_s) {
  p.set_lag(a, b, lag_s);
  p.set_lag(b, a, lag_s);
}

crossing_schedule best(const order_problem& p, order_search::limits most = {}) {
  order_search search{most};
  return search.solve(p, order_of_arrival(p));
}

/// Cars of some lanes that come within a time, most of which meet.
order_problem any_problem(std::size_t lanes, std::size_t cars_each,
                          double within_s, test::dice& dice) {
  std::vector<order_problem::car> cars;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    auto at_s = dice.between(0, 3);
    for (std::size_t k = 0; k < cars_each; ++k) {
      auto x = arrives(at_s, lane);
      x.earliest_s += std::max(0.0, dice.between(-2, 1));
      if (dice.between(0, 1) < 0.3) {
        const auto from_s = dice.between(0, within_s);
        x.closed.push_back({from_s, from_s + dice.between(0, 3)});
      }
      cars.push_back(x);
      at_s += dice.between(0.5, within_s / static_cast<double>(cars_each));
    }
  }
  order_problem p{cars};
  for (std::size_t i = 0; i < cars.size(); ++i)
    for (std::size_t k = 0; k < cars.size(); ++k)
      if (cars[i].lane == cars[k].lane && i < k)
        p.set_lag(i, k, dice.between(1, 2));
      else if (cars[i].lane != cars[k].lane)
        p.set_lag(i, k,
                  (cars[i].lane + cars[k].lane) % 3 == 0
                      ? order_problem::never_meet
                      : dice.between(-0.5, 4));
  return p;
}

/// The least cost of all orders that keep lanes.
double least_cost(const order_problem& p, std::vector<std::size_t>& order) {
  if (order.size() == p.size())
    return timed(p, order).cost;
  auto least = std::numeric_limits<double>::infinity();
  std::vector<bool> is_behind(p.size()); // lanes whose first was tried
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto lane = p.cars()[i].lane;
    if (is_behind[lane] || std::ranges::find(order, i) != order.end())
      continue;
    is_behind[lane] = true;
    order.push_back(i);
    least = std::min(least, least_cost(p, order));
    order.pop_back();
  }
  return least;
}

bool keeps_lanes(const order_problem& p, std::span<const std::size_t> order) {
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (p.cars()[order[i]].lane == p.cars()[order[k]].lane
          && order[i] < order[k])
        return false;
  return true;
}

} // namespace

TEST_CASE("cars that do not meet go when they wish to") {
  const order_problem p{{arrives(1, 0), arrives(1, 1), arrives(2, 2)}};
  const auto s = best(p);
  CHECK(s.cost == Approx(0));
  CHECK(s.at_s == std::vector<double>{1, 1, 2});
  CHECK(s.is_best);
}

TEST_CASE("one car waits for two rather than two for one") {
  order_problem p{{arrives(1, 0), arrives(1.1, 1), arrives(1.1, 2)}};
  meet(p, 0, 1, 3);
  meet(p, 0, 2, 3);
  const auto s = best(p);
  CHECK(s.at_s[0] == Approx(4.1));
  CHECK(s.at_s[1] == Approx(1.1));
  CHECK(s.at_s[2] == Approx(1.1));
  CHECK(timed(p, order_of_arrival(p)).cost == Approx(5.8));
}

TEST_CASE("cars of a lane follow each other") {
  order_problem p{{arrives(5, 0), arrives(5.5, 0)}};
  p.set_lag(0, 1, 2);
  CHECK(best(p).at_s == std::vector<double>{5, 7});
}

TEST_CASE("a car does not come to its line while it is closed") {
  auto late = arrives(5, 0);
  late.closed = {{4, 6}, {6.5, 7}};
  const order_problem p{{late}};
  CHECK(best(p).at_s == std::vector<double>{6});
  CHECK(p.open_s(0, 6.6) == 7);
  CHECK(p.open_s(0, 4) == 4);
}

TEST_CASE("who has waited beyond patience goes before two who have not") {
  auto waits = arrives(0, 0);
  waits.earliest_s = 20;
  order_problem p{{waits, arrives(20, 1), arrives(20, 2)}};
  meet(p, 0, 1, 3);
  meet(p, 0, 2, 3);
  CHECK(best(p).order.front() == 0);
  p.patience_s = 100;
  CHECK(best(p).order.back() == 0);
}

TEST_CASE("the search finds the least cost of all orders") {
  test::dice dice{7};
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    const auto p = any_problem(3 + static_cast<std::size_t>(k % 2), 2, 8, dice);
    const auto s = best(p);
    std::vector<std::size_t> order;
    CHECK(s.is_best);
    CHECK(s.cost == Approx(least_cost(p, order)).epsilon(1e-9));
    CHECK(keeps_lanes(p, s.order));
    CHECK(timed(p, s.order).cost == Approx(s.cost));
    CHECK(timed(p, s.order).at_s == s.at_s);
  }
}

TEST_CASE("where nodes run out, nothing worse than the first order comes") {
  test::dice dice{11};
  auto unfinished = 0;
  for (int k = 0; k < 50; ++k) {
    const auto p = any_problem(6, 3, 12, dice);
    const auto first = order_of_arrival(p);
    const auto s = best(p, {.nodes = 40});
    unfinished += !s.is_best;
    CHECK(s.cost <= timed(p, first).cost);
    CHECK(keeps_lanes(p, s.order));
  }
  CHECK(unfinished > 0);
}

TEST_CASE("labels change how long a search takes, and not what it finds") {
  test::dice dice{13};
  std::size_t with = 0, without = 0;
  for (int k = 0; k < 30; ++k) {
    const auto p = any_problem(4, 3, 10, dice);
    order_search labelled{{.nodes = 1'000'000}};
    order_search plain{{.nodes = 1'000'000, .labels = 0}};
    const auto first = order_of_arrival(p);
    CHECK(labelled.solve(p, first).cost == Approx(plain.solve(p, first).cost));
    with += labelled.nodes();
    without += plain.nodes();
  }
  CHECK(with < without);
}

TEST_CASE("a searcher that is used again finds the same") {
  test::dice dice{17};
  order_search search;
  std::vector<order_problem> problems;
  std::vector<double> costs;
  for (std::size_t k = 0; k < 10; ++k) {
    problems.push_back(any_problem(2 + k % 4, 1 + k % 3, 10, dice));
    costs.push_back(best(problems.back()).cost);
  }
  for (std::size_t k = 0; k < problems.size(); ++k) {
    const auto& p = problems[k];
    CHECK(search.solve(p, order_of_arrival(p)).cost == costs[k]);
  }
}

TEST_CASE("nobody's order takes no time") {
  const order_problem p{{}};
  const auto s = best(p);
  CHECK(s.cost == 0);
  CHECK(s.is_best);
}
