// The entry point of the benchmarks.
#include "scenario/init_messages.hpp"

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  sofof::scenario::init_messages();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
