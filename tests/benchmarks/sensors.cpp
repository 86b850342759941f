// What it costs that everybody looks round.
#include "world/sensing/sensors.hpp"

#include "scenario/placement.hpp"
#include "tests/benchmarks/scenarios.hpp"

#include <benchmark/benchmark.h>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::world;

namespace {

/// Everybody is placed anew, and everybody looks, at the start of a scenario.
void look_round(benchmark::State& state, const scenario_definition& s) {
  std::vector<road_body> bodies;
  for (const auto& v : place_vehicles(s)) {
    const auto pose = v.way->path().at(v.start_s_m);
    bodies.push_back({v.station, body({pose.at, pose.heading_rad}, {}), 8, 0});
  }
  scene all{s.world->map.buildings()};
  const random_stream noise{1, "sensors"};
  time_point t;
  std::size_t seen = 0;
  for (auto _ : state) {
    t += std::chrono::milliseconds{50};
    all.place(bodies);
    for (const auto& b : bodies)
      seen += all.seen_by({s.sensors, noise.part(b.id.value()), b.box.centre,
                           b.box.heading_rad, b.id},
                          t)
                  .size();
  }
  state.SetItemsProcessed(state.iterations()
                          * static_cast<std::int64_t>(bodies.size()));
  state.counters["seen"] = static_cast<double>(seen)
                           / static_cast<double>(state.iterations())
                           / static_cast<double>(bodies.size());
}

void six_look_round(benchmark::State& state) {
  look_round(state, benchmarks::ulm_lehr());
}
BENCHMARK(six_look_round)->Unit(benchmark::kMicrosecond);

void thousand_look_round(benchmark::State& state) {
  look_round(state, benchmarks::scale());
}
BENCHMARK(thousand_look_round)->Unit(benchmark::kMicrosecond);

} // namespace
