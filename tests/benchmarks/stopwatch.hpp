// Times that are spread: the mean, and as counters p50 and p99.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace sofof::benchmarks {

/// Times one piece of work in each iteration of a benchmark that takes its
/// time by hand (`UseManualTime`).
class stopwatch {
public:
  explicit stopwatch(benchmark::State& state) : state_{state} {}

  template <class Work>
  void time(Work&& work) {
    const auto begin = clock::now();
    work();
    const std::chrono::duration<double, std::micro> taken =
        clock::now() - begin;
    state_.SetIterationTime(1e-6 * taken.count());
    times_us_.push_back(taken.count());
  }

  /// After the last iteration.
  void report() {
    std::ranges::sort(times_us_);
    state_.counters["p50_us"] = quantile(0.5);
    state_.counters["p99_us"] = quantile(0.99);
  }

private:
  using clock = std::chrono::steady_clock;

  double quantile(double share) const {
    const auto at = share * static_cast<double>(times_us_.size() - 1);
    return times_us_[static_cast<std::size_t>(at)];
  }

  benchmark::State& state_;
  std::vector<double> times_us_;
};

} // namespace sofof::benchmarks
