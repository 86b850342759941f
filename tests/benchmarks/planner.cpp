// What a planning cycle costs.
#include "planners/lane_follow.hpp"
#include "planners/safe_stop.hpp"
#include "tests/benchmarks/scenarios.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <utility>

using namespace sofof;

namespace {

constexpr duration period = std::chrono::milliseconds{50};

/// One vehicle round Ulm-Lehr, perfectly controlled: each cycle begins where
/// the plan before has led it.
void plan_a_lap(benchmark::State& state, bool with_lead) {
  const auto s = bench::ulm_lehr();
  const auto way = s.world->find("round_trip");
  lane_follow planner{way, {}};
  trajectory plan, before;
  planning_input input;
  for (auto _ : state) {
    std::swap(plan, before);
    planner.plan(input.at, input, before.empty() ? nullptr : &before, plan);
    benchmark::DoNotOptimize(plan.points.data());
    input.at += period;
    const auto p = plan.at(input.at);
    input.s_m = p.s_m;
    input.speed_mps = p.speed_mps;
    input.accel_mps2 = p.accel_mps2;
    input.others.at = input.at;
    if (with_lead)
      input.others.lead = lead_vehicle{1, p.s_m + 25, 8, 0};
  }
}

void lane_follow_alone(benchmark::State& state) {
  plan_a_lap(state, false);
}
BENCHMARK(lane_follow_alone)->Unit(benchmark::kMicrosecond);

void lane_follow_behind_another(benchmark::State& state) {
  plan_a_lap(state, true);
}
BENCHMARK(lane_follow_behind_another)->Unit(benchmark::kMicrosecond);

void safe_stop(benchmark::State& state) {
  const auto s = bench::ulm_lehr();
  const auto way = s.world->find("round_trip");
  planning_input input;
  input.s_m = 100;
  input.speed_mps = 13;
  for (auto _ : state)
    benchmark::DoNotOptimize(sofof::safe_stop(*way, input.at, input));
}
BENCHMARK(safe_stop)->Unit(benchmark::kMicrosecond);

} // namespace
