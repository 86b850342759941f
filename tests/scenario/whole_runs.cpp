// Whole runs in virtual time, judged by their records.
#include "scenario/build.hpp"
#include "scenario/load.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/memory_sink.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

using namespace std::chrono_literals;

const std::string ulm_lehr = SOFOF_SOURCE_DIR "/config/ulm_lehr.toml";

memory_sink drive(std::vector<std::string> overrides) {
  const auto s = load_scenario(ulm_lehr, overrides);
  auto records = std::make_shared<memory_sink>();
  const auto time = make_virtual_runtime();
  const auto actors = build(time->system(), s, records, true);
  time->run_until(time->now() + s.length);
  dismiss(actors, *time);
  return *records;
}

/// Latency of each remote trajectory of one station, by cycle.
std::map<std::uint64_t, duration> latencies(const memory_sink& records,
                                            station_id station) {
  std::map<std::uint64_t, duration> result;
  for (const auto& c : records.cycles)
    if (c.running.station == station
        && c.running.kind == service_name{"trajectory_planning"})
      result[c.cycle] = c.received - c.created;
  return result;
}

void check_safety(const memory_sink& records) {
  CHECK(records.collisions.empty());
  for (const auto& s : records.safety) {
    CHECK(s.without_fresh_plan == 0ns);
    CHECK(s.off_road == 0ns);
    CHECK(s.max_plan_age <= 200ms);
  }
}

} // namespace

TEST_CASE("six vehicles drive a lap, offload once each, and stay safe") {
  const auto records = drive({"duration=230s"});
  check_safety(records);
  std::set<station_id> remote;
  for (const auto& e : records.episodes)
    if (e.of == side::requester && e.got_data)
      remote.insert(e.running.station);
  CHECK(remote.size() == 6);
}

TEST_CASE("a network that stalls makes vehicles fall back, never unsafe") {
  const auto records = drive({"duration=900s", "network.profile=cicv5g-n8"});
  check_safety(records);
  CHECK(std::ranges::any_of(records.episodes, &episode_record::fallback));
}

TEST_CASE("both services are judged and ended on their own") {
  const auto records = drive({"duration=900s", "network.profile=cicv5g-n8"});
  std::map<service_name, int> fallbacks;
  for (const auto& e : records.episodes)
    fallbacks[e.running.kind] += e.fallback;
  CHECK(fallbacks["trajectory_planning"] > 0);
  CHECK(fallbacks["cabin_climate"] == 0); // 2 s and 5 s outlast every stall
}

TEST_CASE("when the CODM or the LODM says never, everybody stays local") {
  for (const auto* policy : {"policies.codm=never", "policies.lodm=never"}) {
    CAPTURE(policy);
    const auto records = drive({"duration=100s", policy});
    check_safety(records);
    CHECK(records.cycles.empty());
    CHECK(records.episodes.empty());
  }
}

TEST_CASE(
    "refused requests are asked again at the next offer, a second later") {
  const auto records = drive({"duration=20s", "policies.codm=never"});
  CHECK(records.decisions.size() > 20);
  CHECK(std::ranges::none_of(records.decisions, &decision_record::accepted));
}

TEST_CASE("a vehicle's noise is its own, whoever else offloads") {
  const std::vector<std::string> common{"duration=100s",
                                        "network.profile=cicv5g-n78"};
  auto alone = common;
  alone.push_back("fleet.0.count=1");
  // Station 101 and its start are the same in both; nobody shares a queue.
  const auto with_others = latencies(drive(common), 101);
  const auto without = latencies(drive(alone), 101);
  REQUIRE(with_others.size() > 100);
  std::size_t compared = 0;
  for (const auto& [cycle, latency] : without)
    if (const auto other = with_others.find(cycle);
        other != with_others.end()) {
      CHECK(other->second == latency);
      ++compared;
    }
  CHECK(compared > 100);
}

TEST_CASE("a smaller area makes shorter offloadings") {
  const auto records = drive({"duration=230s", "provider.0.area_radius_m=110"});
  duration longest{};
  for (const auto& e : records.episodes)
    if (e.of == side::requester)
      longest = std::max(longest, e.ended - e.first_data);
  CHECK(longest > 15s);
  CHECK(longest < 40s); // of about 220 m; 300 m round it take about 70 s
}
