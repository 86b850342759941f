// How many episodes of offloading a second of computing runs: over actors, and
// over the library alone.
#include "tests/properties/actor_world.hpp"
#include "tests/properties/library_world.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>

using namespace sofof;

namespace {

/// One vehicle passes two providers for 200 s, again and again with another
/// seed.
template <class World>
void run_episodes(benchmark::State& state, const char* channel) {
  std::int64_t episodes = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    World w{++seed, {}, 2, channel};
    w.run_for(std::chrono::seconds{200});
    episodes += w.book->remote_episodes;
  }
  state.SetItemsProcessed(episodes);
}

void by_actors(benchmark::State& state, const char* channel) {
  run_episodes<test::actor_world>(state, channel);
}
BENCHMARK_CAPTURE(by_actors, paper, "paper_5g")->Name("actors/paper");
BENCHMARK_CAPTURE(by_actors, ideal, "ideal")->Name("actors/ideal");

void library(benchmark::State& state, const char* channel) {
  run_episodes<test::library_world>(state, channel);
}
BENCHMARK_CAPTURE(library, paper, "paper_5g");
BENCHMARK_CAPTURE(library, ideal, "ideal");

} // namespace
