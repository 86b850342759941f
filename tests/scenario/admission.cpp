// Admission by deadlines, in a whole run: config/busy_worker.toml.
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

/// What a run was like, with a test of one's choice.
struct busy_worker {
  test::memory_sink records;

  explicit busy_worker(const std::string& by) : records{play(by)} {}

  static test::memory_sink play(const std::string& by) {
    const std::vector<std::string> options{"policies.codm.test=" + by,
                                           "duration=10s"};
    return test::play(
        load_scenario(SOFOF_SOURCE_DIR "/config/busy_worker.toml", options));
  }

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

} // namespace

TEST_CASE("by utilisation twelve are accepted, whose plans come too late") {
  const busy_worker run{"utilisation"};
  CHECK(run.most_at_a_time() == 12);
  CHECK(run.longest_latency() > 50ms);
}

TEST_CASE("by processor demand two are accepted, whose plans are in time") {
  const busy_worker run{"demand"};
  CHECK(run.most_at_a_time() == 2);
  CHECK(run.records.cycles.size() > 150);
  CHECK(run.longest_latency() <= 30ms + 2 * 8ms);
}

TEST_CASE("with phases assigned twelve are accepted, and nobody waits") {
  const busy_worker run{"phases"};
  CHECK(run.most_at_a_time() == 12);
  CHECK(run.records.cycles.size() > 1000);
  CHECK(run.longest_latency() == 30ms + 8ms);
}
