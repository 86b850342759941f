// Laws of times, the response of a split, and which split is best.
#include "base/random.hpp"
#include "policies/algorithms/splits/split_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;

namespace {

constexpr provider_id mec = 1;

/// The same time with every service, up, down and on board.
service_times simple(duration period, duration on_board, duration way,
                     duration there) {
  service_times x;
  x.period = period;
  x.on_board = time_law::exactly(on_board);
  x.at[mec] = {time_law::exactly(way), time_law::exactly(there),
               time_law::exactly(way)};
  return x;
}

std::vector<service_times> simple_chain() {
  return {simple({}, 2ms, 10ms, 1ms), simple({}, 3ms, 10ms, 1ms),
          simple(50ms, 15ms, 10ms, 5ms)};
}

duration longest(const chain_split& split) {
  return predicted_response(simple_chain(), split).quantile(1).value();
}

} // namespace

TEST_CASE("a law tells mean and quantiles of what was added") {
  time_law x;
  CHECK_FALSE(x.is_known());
  CHECK_FALSE(x.quantile(0.5));
  for (int k = 1; k <= 100; ++k)
    x.add(k * 1ms);
  CHECK(x.quantile(0.5) == 50ms);
  CHECK(x.quantile(0.99) == 99ms);
  CHECK(x.quantile(1) == 100ms);
  CHECK(to_seconds(*x.mean()) == doctest::Approx(0.0505));
  x.add(5s);
  CHECK(x.quantile(1) == 1s);
}

TEST_CASE("a uniform law has its mean in the middle") {
  CHECK(to_seconds(*time_law::uniform(50ms).mean()) == doctest::Approx(0.025));
  CHECK(time_law::uniform(50ms).quantile(1) == 50ms);
  CHECK(time_law::uniform(0ms).quantile(1) == 0ms);
}

TEST_CASE("the law of two times one after the other is that of drawn sums") {
  const random_stream noise{1, "sums"};
  time_law x, y, drawn;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    x.add(from_seconds(0.02 * noise.part("x").uniform(k)));
    y.add(from_seconds(0.1 * std::pow(noise.part("y").uniform(k), 3)));
  }
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const auto a = 0.02 * noise.part("x").uniform(k % 2000);
    const auto b = 0.1 * std::pow(noise.part("y").uniform(k * 7 % 2000), 3);
    drawn.add(from_seconds(a + b));
  }
  const auto sum = after(x, y);
  for (const auto p : {0.1, 0.5, 0.9, 0.99})
    CHECK(std::abs(to_seconds(*sum.quantile(p) - *drawn.quantile(p))) < 0.003);
  CHECK_FALSE(after(x, {}).is_known());
}

TEST_CASE("what begins with a control step ends with one, and half of what "
          "counts as a multiple is a little longer") {
  time_law x;
  for (const auto t : {1ms, 9ms, 10ms, 15ms})
    x.add(t);
  const auto ended = until_multiple_of(10ms, x);
  CHECK(ended.quantile(0.625) == 10ms);
  CHECK(ended.quantile(0.63) == 20ms);
  CHECK(ended.count() == 4);
  CHECK(until_multiple_of(10ms, time_law::exactly(5s)).quantile(1) == 1s);
  CHECK_FALSE(until_multiple_of(10ms, {}).is_known());
}

/// @returns the end of the control step in which it ends.
constexpr duration to_step(duration t) {
  return (t / 10ms + 1) * 10ms;
}

TEST_CASE("each service waits for the one before it, and one with a period for "
          "its next cycle") {
  CHECK(longest({{}, {}, {}}) == to_step(2ms + 3ms + 50ms + 15ms));
  CHECK(longest({mec, {}, {}}) == to_step(21ms + 3ms + 50ms + 15ms));
  CHECK(longest({{}, mec, {}}) == to_step(2ms + 21ms + 50ms + 15ms));
  CHECK(longest({{}, {}, mec})
        == to_step(2ms + 3ms + 10ms + 50ms + 5ms + 10ms));
}

TEST_CASE("a service with a period asks those before it where it runs, and one "
          "that is called by inputs waits for them") {
  CHECK(longest({mec, mec, mec}) == to_step(10ms + 50ms + 5ms + 10ms));
  CHECK(longest({{}, mec, mec}) == to_step(2ms + 10ms + 50ms + 5ms + 10ms));
  CHECK(longest({mec, mec, {}}) == to_step(21ms + 21ms + 50ms + 15ms));
}

TEST_CASE("of looks that are more than go up, the next one stands in") {
  auto chain = simple_chain();
  chain[0].input_period = 100ms;
  const auto most = [&](const chain_split& split) {
    return predicted_response(chain, split).quantile(1).value();
  };
  CHECK(most({{}, {}, {}}) == longest({{}, {}, {}}));
  CHECK(most({mec, {}, {}}) == longest({mec, {}, {}}) + 50ms);
  chain[1].input_period = chain[2].input_period = 100ms;
  CHECK(most({mec, {}, mec}) == longest({mec, {}, mec}) + 50ms);
}

TEST_CASE("nothing is predicted of a place of which nothing is known") {
  CHECK_FALSE(predicted_response(simple_chain(), {{}, 2, {}}).is_known());
  auto chain = simple_chain();
  chain[1].on_board = {};
  CHECK_FALSE(predicted_response(chain, {{}, {}, {}}).is_known());
}

TEST_CASE("the best of all splits is no worse than any, and greedy moves end "
          "where no single one is better") {
  const random_stream noise{3, "costs"};
  std::uint64_t draw = 0;
  int greedy_is_best = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = 1 + static_cast<std::size_t>(trial) % 4;
    const std::vector<std::vector<service_place>> places(n, {{}, 1, 2});
    std::map<chain_split, double> costs;
    const auto cost = [&](const chain_split& split) {
      const auto [i, is_new] = costs.try_emplace(split);
      if (is_new)
        i->second = noise.uniform(draw++);
      return i->second;
    };
    const auto best = best_split(places, cost);
    std::size_t all = 1;
    for (std::size_t k = 0; k < n; ++k)
      all *= 3;
    REQUIRE(costs.size() == all);
    const auto least = std::ranges::min_element(
        costs, {}, [](const auto& x) { return x.second; });
    CHECK(cost(best) == least->second);
    const auto greedy = greedy_split(places, chain_split(n), cost);
    CHECK(cost(greedy) <= cost(chain_split(n)));
    for (std::size_t k = 0; k < n; ++k)
      for (const auto& place : places[k]) {
        auto moved = greedy;
        moved[k] = place;
        CHECK(cost(moved) >= cost(greedy));
      }
    greedy_is_best += cost(greedy) == cost(best);
  }
  CHECK(greedy_is_best > 60);
  CHECK(greedy_is_best < 200);
}
