// What planning all cars at a crossing takes.
#include "planners/crossing/order_search.hpp"
#include "tests/benchmarks/stopwatch.hpp"
#include "tests/planners/conducted_cars.hpp"
#include "tests/planners/crossing_cases.hpp"

#include <cstdint>

using namespace sofof;
using namespace sofof::planners;

namespace {

constexpr std::size_t cars_at_once = 18;

/// All known at once, as in tests/planners/order_cases.cpp, each time others;
/// `proven` is the share of those whose best order is known to be it.
void order_of_18(benchmark::State& state) {
  const test::four_arms crossing;
  test::dice dice{31};
  order_search search;
  benchmarks::stopwatch watch{state};
  auto proven = 0.0;
  for (auto _ : state) {
    const auto problem = test::any_traffic(crossing, 3, 4, dice);
    const auto first = order_of_arrival(problem);
    watch.time([&] { proven += search.solve(problem, first).is_best; });
  }
  watch.report();
  state.counters["proven"] = proven / static_cast<double>(state.iterations());
}
BENCHMARK(order_of_18)->UseManualTime()->Iterations(500);

/// A cycle, drives included: who has come through is followed by another one.
void crossing_cycle_of_18(benchmark::State& state) {
  constexpr double room_m = 15, shortest_m = 5;
  test::dice dice{32};
  test::conducted_cars at;
  std::uint32_t last = 100;
  const auto add = [&] {
    const auto in = static_cast<std::size_t>(dice.between(1, 5));
    const auto out =
        1 + (in - 1 + static_cast<std::size_t>(dice.between(1, 4))) % 4;
    at.add(++last, in, out, shortest_m);
    const auto& own = at.cars.back(); // the highest number
    const auto lane = own.way->line.way().sequence()[0];
    if (std::ranges::any_of(at.cars, [&](const auto& x) {
          return x.who != own.who && x.s_m < room_m
                 && x.way->line.way().sequence()[0] == lane;
        }))
      at.cars.pop_back();
  };
  benchmarks::stopwatch watch{state};
  auto cars = 0.0;
  for (auto _ : state) {
    for (int k = 0; k < 8 && at.cars.size() < cars_at_once; ++k)
      add();
    cars += static_cast<double>(at.cars.size());
    watch.time([&] { at.plan(); });
    at.go_on();
  }
  watch.report();
  state.counters["cars"] = cars / static_cast<double>(state.iterations());
  state.counters["touches"] = at.touches;
}
BENCHMARK(crossing_cycle_of_18)->UseManualTime()->Iterations(2000);

} // namespace
