// What the channel's draws cost.
#include "channel/link_direction.hpp"
#include "channel/provider_compute.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

using namespace sofof;
using namespace sofof::channel;

namespace {

constexpr duration between_results = std::chrono::milliseconds{50};

/// Computing time and downlink of one result.
void result_through(benchmark::State& state, const std::string& profile) {
  const auto definition =
      std::make_shared<const channel_profile>(*find_channel_profile(profile));
  const random_stream seed{1, "benchmark"};
  const auto computers = compute_measured_with(profile);
  const auto draws = result_draws(seed, 101, 1);
  link_direction link{channel_draws{definition, seed, 101, 1}, direction::down,
                      std::make_shared<shared_server_queue>(1)};
  std::uint64_t cycle = 0;
  time_point created;
  for (auto _ : state) {
    const auto sent = created + computers.computing_time(draws, cycle);
    benchmark::DoNotOptimize(link.arrival(sent, message_class::result, cycle));
    created += between_results;
    ++cycle;
  }
}
BENCHMARK_CAPTURE(result_through, ideal, "ideal");
BENCHMARK_CAPTURE(result_through, paper_sim, "paper_sim");
BENCHMARK_CAPTURE(result_through, paper_sim_stalls, "paper_sim_stalls");
BENCHMARK_CAPTURE(result_through, paper_5g, "paper_5g");
BENCHMARK_CAPTURE(result_through, cicv5g_n78, "cicv5g_n78");

} // namespace
