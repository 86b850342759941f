// What the channel's draws cost.
#include "channel/link_direction.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

using namespace sofof;

namespace {

constexpr duration between_results = std::chrono::milliseconds{50};

/// Computing time and downlink of one result.
void result_through(benchmark::State& state, const std::string& profile) {
  const auto definition =
      std::make_shared<const channel_profile>(*find_channel_profile(profile));
  const channel draws{definition, random_stream{1, "benchmark"}, 101, 1};
  link_direction link{draws, direction::down,
                      std::make_shared<multi_server_queue>(1)};
  std::uint64_t cycle = 0;
  time_point created;
  for (auto _ : state) {
    const auto sent = created + draws.service_time(cycle);
    benchmark::DoNotOptimize(link.arrival(sent, message_class::result, cycle));
    created += between_results;
    ++cycle;
  }
}
BENCHMARK_CAPTURE(result_through, ideal, "ideal");
BENCHMARK_CAPTURE(result_through, paper_sim, "paper-sim");
BENCHMARK_CAPTURE(result_through, paper_sim_stalls, "paper-sim-stalls");
BENCHMARK_CAPTURE(result_through, paper_5g, "paper-5g");
BENCHMARK_CAPTURE(result_through, cicv5g_n78, "cicv5g-n78");

} // namespace
