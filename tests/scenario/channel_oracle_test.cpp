// Tests of what policies are told of the future.
#include "scenario/channel_oracle.hpp"

#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"
#include "tests/support/bench_town.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

constexpr std::string_view planning = "trajectory_planning";

foreseen_results look(const std::vector<std::string>& set, provider_id provider,
                      duration from, duration until) {
  const auto s = parse_scenario(test::bench_town, "town.toml", set);
  return foresee(s)(101)->look(provider, planning, time_point{from},
                               time_point{until});
}

} // namespace

TEST_CASE("on an ideal channel nothing is late and computing is all it takes") {
  const auto seen = look({}, provider_at(1, 0), 0s, 60s);
  CHECK_FALSE(seen.late);
  CHECK(seen.latency_s == doctest::Approx(0.008));
}

TEST_CASE("where nobody is everything is late") {
  CHECK(look({}, provider_at(2, 0), 3s, 60s).late == time_point{3s});
}

TEST_CASE("it is foreseen when a provider fails and when it is back") {
  const std::vector<std::string> set{"provider.0.fails_at=20s",
                                     "provider.0.returns_at=30s"};
  const auto before = look(set, provider_at(1, 0), 0s, 60s);
  REQUIRE(before.late);
  CHECK(before.late->time_since_epoch() > 19900ms);
  CHECK(before.late->time_since_epoch() <= 20100ms);
  CHECK(look(set, provider_at(1, 1), 29s, 60s).late);
  CHECK_FALSE(look(set, provider_at(1, 1), 30s, 60s).late);
}

// One vehicle, so that nobody waits for a worker or for the radio cell. Delays
// go on from those before, and a run has not all of them: a little is left.
TEST_CASE("what is foreseen of a channel is what comes in a run") {
  const std::filesystem::path folder = SOFOF_SOURCE_DIR "/config/bench";
  const std::vector<std::string> set{"duration=300s", "fleet.0.count=1",
                                     "policies.lodm=\"always\"",
                                     "policies.codm=\"always\""};
  std::size_t late = 0;
  for (const std::string name : {"spiky_5g", "tunnel", "two_operators"}) {
    CAPTURE(name);
    const auto s = load_scenario(folder / (name + ".toml"), set);
    const auto future = foresee(s)(101);
    const auto records = test::play(s);
    std::size_t in_time = 0, off_grid = 0;
    for (const auto& cycle : records.cycles) {
      const auto seen = future->look(cycle.session.provider, planning,
                                     cycle.created, cycle.created + 1ns);
      if (!seen.late && seen.latency_s == 0) {
        ++off_grid; // the first of an offloading is run at once
        continue;
      }
      const auto latency = cycle.received - cycle.created;
      CAPTURE(to_seconds(cycle.created.time_since_epoch()));
      CHECK(seen.late.has_value() == (latency > 50ms));
      if (!seen.late)
        CHECK(std::abs(seen.latency_s - to_seconds(latency)) < 1e-3);
      ++(seen.late ? late : in_time);
    }
    CHECK(in_time > 3000);
    CHECK(off_grid <= records.episodes.size());
  }
  CHECK(late > 5);
}
