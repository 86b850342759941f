// What a path, a velocity and both together cost to plan, warm and cold: the
// mean, and as counters p50 and p99. Carrying the last plan over is part of it.
#include "planners/problems/sample_problems.hpp"
#include "tests/benchmarks/stopwatch.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>

using namespace sofof;
using namespace sofof::planners;

namespace {

constexpr int drive = 240; // knots, then it begins again

/// Down the slalom, knot by knot.
class path_driver {
public:
  path_driver(int steps, double ds_m) : road_{steps, ds_m} {}

  /// Poses the next problem, untimed.
  void drive_on(bool warm) {
    knot_ = (knot_ + 1) % drive;
    warm_ = warm && knot_ > 0;
    if (knot_ == 0)
      state_ = {};
    problem_ = &road_.at(knot_, state_);
  }

  void solve() {
    if (warm_)
      solver_->shift(1);
    benchmark::DoNotOptimize(
        solver_->solve(*problem_, warm_ ? ocp::start::warm : ocp::start::cold));
  }

  void arrive() {
    state_ = {solver_->offset_m()[1], solver_->heading_rad()[1],
              solver_->curvature_1pm()[1]};
  }

private:
  slalom road_;
  std::unique_ptr<path_ocp> solver_ = std::make_unique<path_ocp>();
  const path_problem* problem_ = nullptr;
  path_state state_;
  int knot_ = -1;
  bool warm_ = false;
};

/// Along a practice road, metre by metre.
class velocity_driver {
public:
  velocity_driver(practice_road::event what, int steps) : road_{what, steps} {}

  void drive_on(bool warm) {
    knot_ = (knot_ + stride) % drive;
    warm_ = warm && knot_ > 0;
    if (knot_ == 0) {
      state_ = {.t_s = 0, .w_m2ps2 = 60, .accel_mps2 = 0};
      now_s_ = 0;
    }
    problem_ = &road_.at(knot_, now_s_, state_);
  }

  void solve() {
    if (warm_)
      solver_->shift(stride);
    benchmark::DoNotOptimize(
        solver_->solve(*problem_, warm_ ? ocp::start::warm : ocp::start::cold));
  }

  void arrive() {
    now_s_ += solver_->t_s()[stride];
    state_ = {0, std::max(0., solver_->w_m2ps2()[stride]),
              solver_->accel_mps2()[stride]};
  }

private:
  static constexpr int stride = 2;

  practice_road road_;
  std::unique_ptr<velocity_ocp> solver_ = std::make_unique<velocity_ocp>();
  const velocity_problem* problem_ = nullptr;
  velocity_state state_;
  double now_s_ = 0;
  int knot_ = -stride;
  bool warm_ = false;
};

template <class... Driver>
void plan(benchmark::State& state, bool warm, Driver&&... drivers) {
  benchmarks::stopwatch watch{state};
  for (auto _ : state) {
    (drivers.drive_on(warm), ...);
    watch.time([&] { (drivers.solve(), ...); });
    (drivers.arrive(), ...);
  }
  watch.report();
}

constexpr auto free_flow = practice_road::event::free_flow;
constexpr auto leader = practice_road::event::slow_leader;

void path_80_warm(benchmark::State& state) {
  plan(state, true, path_driver{80, 1});
}
BENCHMARK(path_80_warm)->Unit(benchmark::kMicrosecond)->UseManualTime();

void path_80_cold(benchmark::State& state) {
  plan(state, false, path_driver{80, 1});
}
BENCHMARK(path_80_cold)->Unit(benchmark::kMicrosecond)->UseManualTime();

void path_250_warm(benchmark::State& state) {
  plan(state, true, path_driver{250, 0.5});
}
BENCHMARK(path_250_warm)->Unit(benchmark::kMicrosecond)->UseManualTime();

void velocity_250_free_flow(benchmark::State& state) {
  plan(state, true, velocity_driver{free_flow, 250});
}
BENCHMARK(velocity_250_free_flow)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

void velocity_250_leader(benchmark::State& state) {
  plan(state, true, velocity_driver{leader, 250});
}
BENCHMARK(velocity_250_leader)->Unit(benchmark::kMicrosecond)->UseManualTime();

void path_and_velocity_250(benchmark::State& state) {
  plan(state, true, path_driver{250, 0.5}, velocity_driver{free_flow, 250});
}
BENCHMARK(path_and_velocity_250)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

} // namespace
