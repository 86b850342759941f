// What it takes to prove an assignment of 40 vehicles to 3 providers optimal.
#include "policies/algorithms/assignment/branch_and_bound.hpp"
#include "tests/support/assignments.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>

using namespace sofof;
using namespace sofof::policies;

namespace {

/// The problems of tests/reference/assignment.cpp.
void assign_40_to_3(benchmark::State& state) {
  test::dice random{static_cast<std::uint64_t>(state.range(0))};
  auto p = test::open_problem(40, 3);
  p.gains = test::table_between(random, 40, 3, 0.1, 1);
  p.switching_price = 0.05;
  test::place_at_random(p, random);
  p.resources.push_back(test::scarce(random, 40, 3, 0.6));
  for (auto _ : state)
    if (!assignment::branch_and_bound(p).proved)
      state.SkipWithError("It is not proved.");
}
BENCHMARK(assign_40_to_3)->DenseRange(0, 9)->Unit(benchmark::kMillisecond);

} // namespace
