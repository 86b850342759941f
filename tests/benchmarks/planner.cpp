// What a planning cycle costs.
#include "planners/trajectory/lane_follow.hpp"
#include "planners/trajectory/safe_stop.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "tests/benchmarks/scenarios.hpp"
#include "tests/benchmarks/stopwatch.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <utility>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

constexpr duration planning_period = std::chrono::milliseconds{50};

/// The car ahead takes 300 s for the 2.4 km.
constexpr auto lead_mps = 8.0;
constexpr auto lap_cycles = 6000;

void a_lap(benchmark::internal::Benchmark* b) {
  b->Iterations(lap_cycles)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

/// One vehicle round Ulm-Lehr, perfectly controlled: each cycle begins where
/// the plan before has led it. Another may drive ahead, at constant speed.
void drive_round(benchmark::State& state, trajectory_planner& planner,
                 bool with_lead) {
  benchmarks::stopwatch watch{state};
  trajectory plan, before;
  planning_input input;
  if (with_lead)
    input.others.lead = lead_vehicle{1, 25, lead_mps, 0};
  for (auto _ : state) {
    std::swap(plan, before);
    watch.time([&] {
      planner.plan(input.at, input, before.empty() ? nullptr : &before, plan);
    });
    input.at += planning_period;
    const auto p = plan.at(input.at);
    input.s_m = p.s_m;
    input.speed_mps = p.speed_mps;
    input.accel_mps2 = p.accel_mps2;
    input.others.at = input.at;
    if (with_lead)
      input.others.lead->rear_s_m += lead_mps * to_seconds(planning_period);
  }
  watch.report();
}

void follow_lane(benchmark::State& state, bool with_lead) {
  const auto s = benchmarks::ulm_lehr();
  lane_follow planner{s.world->find("round_trip"), {}};
  drive_round(state, planner, with_lead);
}

void optimise(benchmark::State& state, const spatial_params& params,
              bool with_lead) {
  const auto s = benchmarks::ulm_lehr();
  spatial_planner planner{std::make_shared<route_profile>(
                              s.world->find("round_trip"), comfort_limits{}),
                          {},
                          params};
  drive_round(state, planner, with_lead);
}

/// The parameters of config/ulm_lehr.toml.
const spatial_params onboard;
const spatial_params mec{
    .horizon_m = 125, .step_m = 0.5, .candidates = 16, .alternations = 2};

void lane_follow_alone(benchmark::State& state) {
  follow_lane(state, false);
}
BENCHMARK(lane_follow_alone)->Apply(a_lap);

void lane_follow_behind_another(benchmark::State& state) {
  follow_lane(state, true);
}
BENCHMARK(lane_follow_behind_another)->Apply(a_lap);

void onboard_alone(benchmark::State& state) {
  optimise(state, onboard, false);
}
BENCHMARK(onboard_alone)->Apply(a_lap);

void onboard_behind_another(benchmark::State& state) {
  optimise(state, onboard, true);
}
BENCHMARK(onboard_behind_another)->Apply(a_lap);

void mec_alone(benchmark::State& state) {
  optimise(state, mec, false);
}
BENCHMARK(mec_alone)->Apply(a_lap);

void mec_behind_another(benchmark::State& state) {
  optimise(state, mec, true);
}
BENCHMARK(mec_behind_another)->Apply(a_lap);

void safe_stop(benchmark::State& state) {
  const auto s = benchmarks::ulm_lehr();
  const auto way = s.world->find("round_trip");
  planning_input input;
  input.s_m = 100;
  input.speed_mps = 13;
  for (auto _ : state)
    benchmark::DoNotOptimize(sofof::planners::safe_stop(*way, input.at, input));
}
BENCHMARK(safe_stop)->Unit(benchmark::kMicrosecond);

} // namespace
