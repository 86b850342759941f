// What 10 ms of driving cost.
#include "world/vehicle/vehicle.hpp"

#include "planners/trajectory/lane_follow.hpp"
#include "tests/benchmarks/scenarios.hpp"

#include <benchmark/benchmark.h>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

constexpr duration motion_step = std::chrono::milliseconds{10};

/// Follows one plan from its begin to its end, again and again.
void control_and_step(benchmark::State& state) {
  const auto s = benchmarks::ulm_lehr();
  const auto way = s.world->find("round_trip");
  planning_input input;
  input.speed_mps = 8;
  trajectory plan;
  lane_follow{way, {}}.plan(input.at, input, nullptr, plan);
  const vehicle_params car;
  const auto& first = plan.points.front();
  const vehicle_state start{first.at, first.heading_rad, first.speed_mps};
  auto x = start;
  auto t = plan.start;
  for (auto _ : state) {
    x = step(x, follow(x, plan, t, car), car, to_seconds(motion_step));
    benchmark::DoNotOptimize(x);
    t += motion_step;
    if (t > plan.end()) {
      x = start;
      t = plan.start;
    }
  }
}
BENCHMARK(control_and_step);

/// Where on its route a car is.
void project(benchmark::State& state) {
  const auto s = benchmarks::ulm_lehr();
  const auto way = s.world->find("round_trip");
  double s_m = 0;
  for (auto _ : state) {
    const auto at = way->path().at(s_m).at;
    benchmark::DoNotOptimize(way->path().project(at, s_m, 5));
    s_m += 0.1;
  }
}
BENCHMARK(project);

} // namespace
