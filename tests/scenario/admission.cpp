// Admission by deadlines and by response times, in a whole run:
// config/busy_worker.toml.
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

/// What a run was like.
struct busy_worker {
  test::memory_sink records;

  /// How many services ran at the provider at a time, at most.
  std::ptrdiff_t most_at_a_time() const {
    std::ptrdiff_t most = 0;
    for (const auto& one : records.episodes)
      most = std::max(most, std::ranges::count_if(
                                records.episodes, [&one](const auto& other) {
                                  return other.of == side::provider
                                         && other.accepted <= one.accepted
                                         && one.accepted < other.ended;
                                }));
    return most;
  }

  duration longest_latency() const {
    duration longest{};
    for (const auto& c : records.cycles)
      longest = std::max(longest, c.received - c.created);
    return longest;
  }
};

busy_worker run_with(std::vector<std::string> options) {
  options.emplace_back("duration=10s");
  return {test::play(
      load_scenario(SOFOF_SOURCE_DIR "/config/busy_worker.toml", options))};
}

/// @param test  Of one's choice.
busy_worker run_by(const std::string& test) {
  return run_with({"policies.codm.test=" + test});
}

} // namespace

TEST_CASE("by utilisation twelve are accepted, whose plans come too late") {
  const auto run = run_by("utilisation");
  CHECK(run.most_at_a_time() == 12);
  CHECK(run.longest_latency() > 50ms);
}

TEST_CASE("by processor demand two are accepted, whose plans are in time") {
  const auto run = run_by("demand");
  CHECK(run.most_at_a_time() == 2);
  CHECK(run.records.cycles.size() > 150);
  CHECK(run.longest_latency() <= 30ms + 2 * 8ms);
}

TEST_CASE("with phases assigned twelve are accepted, and nobody waits") {
  const auto run = run_by("phases");
  CHECK(run.most_at_a_time() == 12);
  CHECK(run.records.cycles.size() > 1000);
  CHECK(run.longest_latency() == 30ms + 8ms);
}

TEST_CASE("by response times as many are accepted as may come together, on all "
          "workers") {
  const std::string codm =
      R"(policies.codm={name="response_time",network="30ms",filter="none"})";
  const auto one = run_with({codm});
  CHECK(one.most_at_a_time() == 2);
  CHECK(one.longest_latency() <= 30ms + 2 * 8ms);
  const auto three = run_with({codm, "compute.workers=3"});
  CHECK(three.most_at_a_time() == 5); // (4 · 8 / 3 + 8) ms
  CHECK(three.records.cycles.size() > 300);
  CHECK(three.longest_latency() <= 50ms);
}
