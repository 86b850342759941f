// Tests of how many vehicles a provider is said to carry, from made-up results.
#include "experiments/load_test/load_test.hpp"

#include "experiments/load_test/load_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::experiments::load_test;
using namespace std::chrono_literals;

namespace {

constexpr double period_s = 0.05;
const counted_window window{4, 14, 50ms};

/// A provider that begins cycle `k` of a station so late, computes it for 1 ms,
/// and needs 2 ms more to bring its result.
report::cycle_line result(std::uint64_t station, std::uint64_t k,
                          double late_ms = 0) {
  report::cycle_line x;
  x.of = {"mec", "trajectory_planning", 1, station, 1};
  x.cycle = k;
  x.latency_ms = 3;
  const auto phase_s = 1e-3 * static_cast<double>(station);
  x.received_s = period_s * static_cast<double>(k) + phase_s
                 + 1e-3 * (late_ms + x.latency_ms);
  x.parts = report::time_parts{.computing = 1};
  return x;
}

served_step counted(const std::vector<report::cycle_line>& lines) {
  served_step step;
  step.vehicles = 1;
  count_results(lines, window, step);
  return step;
}

/// @returns what a search finds where a provider carries so many, and how often
/// it tries.
std::pair<std::int64_t, int> found(std::int64_t carries, std::int64_t most) {
  load_search search{10, most};
  int tries = 0;
  while (const auto n = search.next()) {
    search.add(*n, *n <= carries);
    ++tries;
  }
  return {search.carried(), tries};
}

} // namespace

TEST_CASE("waiting is how much later than the earliest of its session a cycle "
          "begins") {
  std::vector<report::cycle_line> lines;
  for (std::uint64_t k = 100; k < 200; ++k)
    lines.push_back(result(7, k, k % 2 == 0 ? 0 : 5));
  const auto step = counted(lines);
  CHECK(step.served == 1);
  CHECK(step.results == 100);
  CHECK(step.due == 200); // one each 50 ms
  CHECK(step.exchanged_per_s() == doctest::Approx(10));
  CHECK(step.response.quantile_ms(0.5) == doctest::Approx(1).epsilon(0.02));
  CHECK(step.response.quantile_ms(0.99) == doctest::Approx(6).epsilon(0.02));
  CHECK(step.latency.quantile_ms(0.99) == doctest::Approx(3).epsilon(0.02));
}

TEST_CASE("stations may have any phase") {
  std::vector<report::cycle_line> lines;
  for (std::uint64_t k = 100; k < 200; ++k)
    for (std::uint64_t station = 1; station <= 40; ++station)
      lines.push_back(result(station, k));
  const auto step = counted(lines);
  CHECK(step.served == 40);
  CHECK(step.response.ms().max() == doctest::Approx(1));
}

TEST_CASE("a cycle that is missing counts as a period late") {
  std::vector<report::cycle_line> lines;
  for (std::uint64_t k = 100; k < 200; ++k)
    if (k < 120 || k >= 130)
      lines.push_back(result(7, k));
  const auto step = counted(lines);
  CHECK(step.results == 90);
  CHECK(step.response.ms().count() == 100);
  CHECK(step.response.quantile_ms(0.99) == doctest::Approx(50));
}

TEST_CASE("results from before the window and after it do not count") {
  CHECK(counted({result(7, 79), result(7, 281)}).results == 0);
  CHECK(counted({result(7, 80), result(7, 279)}).results == 2);
}

TEST_CASE("so many are carried if 99 of 100 results come, and in time") {
  served_step step;
  CHECK(!is_carried(step, 20ms)); // nothing is known
  step.due = step.results = 100;
  for (int k = 0; k < 99; ++k)
    step.response.add(20ms);
  step.response.add(90ms);
  CHECK(is_carried(step, 20ms));
  CHECK(!is_carried(step, 19ms));
  step.due = 102; // some vehicles fell back
  CHECK(!is_carried(step, 20ms));
  step.due = 100;
  step.response.add(90ms);
  CHECK(!is_carried(step, 20ms));
}

TEST_CASE("a search finds how many are carried, to a tenth, in few steps") {
  for (std::int64_t carries = 0; carries <= 1000; ++carries) {
    const auto [carried, tries] = found(carries, 1000);
    CAPTURE(carries);
    CHECK(carried <= carries);
    CHECK(carries - carried <= std::max<std::int64_t>(1, carried / 10));
    CHECK(tries <= 12);
  }
}

TEST_CASE("a search never tries more than it may") {
  CHECK(found(5000, 64).first == 64);
  CHECK(found(5000, 10).second == 1);
}
