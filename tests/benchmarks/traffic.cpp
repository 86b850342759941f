// What it costs to know who is ahead of whom, and whose turn it is.
#include "world/traffic/traffic.hpp"

#include "scenario/placement.hpp"
#include "tests/benchmarks/scenarios.hpp"

#include <benchmark/benchmark.h>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::world;

namespace {

constexpr duration look_period = std::chrono::milliseconds{100};
constexpr double speed_mps = 8;

/// Everybody reports, one update, everybody looks; all creep on, so that
/// lanes and crossings change hands.
void update(benchmark::State& state, const scenario_definition& s) {
  traffic users{s.world->map};
  auto vehicles = place_vehicles(s);
  time_point t;
  const vehicle_params car;
  for (auto _ : state) {
    for (auto& v : vehicles) {
      const auto pose = v.way->path().at(v.start_s_m);
      const vehicle_state x{pose.at, pose.heading_rad, speed_mps};
      road_user user;
      user.station = v.station;
      user.on = v.way;
      user.s_m = v.start_s_m;
      user.speed_mps = speed_mps;
      user.body = body(x, car);
      users.report(user);
      v.start_s_m += speed_mps * to_seconds(look_period);
    }
    t += look_period;
    users.update(t);
    for (const auto& v : vehicles)
      benchmark::DoNotOptimize(users.perceive(v.station));
    benchmark::DoNotOptimize(users.collisions());
  }
  state.SetItemsProcessed(state.iterations()
                          * static_cast<std::int64_t>(vehicles.size()));
}

void six_vehicles(benchmark::State& state) {
  update(state, benchmarks::ulm_lehr());
}
BENCHMARK(six_vehicles)->Unit(benchmark::kMicrosecond);

void thousand_vehicles(benchmark::State& state) {
  update(state, benchmarks::scale());
}
BENCHMARK(thousand_vehicles)->Unit(benchmark::kMicrosecond);

} // namespace
