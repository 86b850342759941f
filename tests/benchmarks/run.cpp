// What whole scenarios cost, with and without the files that they write.
#include "scenario/run.hpp"

#include "messages/protocol/no_records.hpp"
#include "scenario/build.hpp"
#include "scenario/runtime.hpp"
#include "tests/benchmarks/scenarios.hpp"

#include <benchmark/benchmark.h>

#include <atomic>
#include <filesystem>
#include <sstream>
#include <unistd.h>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;

namespace {

/// One virtual second after the other of a run that has settled in.
void count_messages(benchmark::State& state, const scenario_definition& s) {
  const auto time = make_virtual_runtime();
  const auto actors = build(time->system(), s, std::make_shared<no_records>(),
                            time->clock(), true);
  time->run_until(time->now() + std::chrono::seconds{30});
  auto& handled = *time->system().base_metrics().processed_messages;
  const auto before = handled.value();
  for (auto _ : state)
    time->run_until(time->now() + std::chrono::seconds{1});
  const auto count = static_cast<double>(handled.value() - before);
  state.counters["messages_per_virtual_s"] =
      count / static_cast<double>(state.iterations());
  state.counters["messages_per_s"] =
      benchmark::Counter(count, benchmark::Counter::kIsRate);
  dismiss(actors, *time);
}

void virtual_second_of_six(benchmark::State& state) {
  count_messages(state, benchmarks::ulm_lehr());
}
BENCHMARK(virtual_second_of_six)->Unit(benchmark::kMicrosecond);

void virtual_second_of_thousand(benchmark::State& state) {
  count_messages(state, benchmarks::scale());
}
BENCHMARK(virtual_second_of_thousand)->Unit(benchmark::kMillisecond);

/// As `sofof run`, files and all.
void whole_run(benchmark::State& state, const scenario_definition& s) {
  namespace fs = std::filesystem;
  const auto out = fs::temp_directory_path()
                   / ("sofof_benchmark_" + std::to_string(getpid()));
  run_options options;
  options.out = out;
  options.force = true;
  const std::atomic<bool> interrupted{false};
  std::ostringstream console;
  for (auto _ : state)
    if (run(s, options, interrupted, console) != run_outcome::good)
      state.SkipWithError("the run was not good");
  fs::remove_all(out);
  state.counters["x_real_time"] = benchmark::Counter(
      to_seconds(s.length) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

void half_an_hour_of_six(benchmark::State& state) {
  whole_run(state, benchmarks::ulm_lehr({"duration=1800s"}));
}
BENCHMARK(half_an_hour_of_six)->Unit(benchmark::kSecond);

void minute_of_thousand(benchmark::State& state) {
  whole_run(state, benchmarks::scale());
}
BENCHMARK(minute_of_thousand)->Unit(benchmark::kSecond)->Iterations(1);

} // namespace
