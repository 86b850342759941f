// Limits that the scene sets, in whole runs.
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr auto scene_limited = R"(
name = "scene"
duration = "40s"
map = "maps/ulm_lehr.toml"
[[fleet]]
count = 6
routes = ["round_trip"]
placement = "convoy"
spacing_m = 14.0
start_speed_mps = 8.0
[[provider]]
position_m = [0.0, 0.0]
area_radius_m = 1000.0
[network]
profile = "paper_5g"
more_delay = "60ms"
[policies]
lodm = "always"
codm = "always"
[[service]]
name = "trajectory_planning"
max_latency = "scene"
max_latency_cap = "600ms"
max_latency_floor = "250ms"
max_input_age = "2s"
)";

/// The services before planning, at home or at the provider.
constexpr auto chain_before = R"(
[[service]]
name = "tracking"
max_latency = "300ms"
[[service]]
name = "environment_model"
max_latency = "300ms"
)";

constexpr auto offers_all = R"(
services = ["tracking", "environment_model", "trajectory_planning"]
)";

constexpr auto gap = 100ms, run_time = 45ms, least = 250ms, cap = 600ms;

} // namespace

TEST_CASE("where the scene limits results, none is used that is older than the "
          "cap or than the scene allows, and who comes home for its sake does "
          "so for no fault") {
  const auto run = play(scenario::parse_scenario(
      scene_limited,
      std::filesystem::path{SOFOF_SOURCE_DIR} / "config/scene.toml", {}));
  CHECK(run.collisions.empty());
  const auto left_at = [&](station_id station, time_point t) {
    auto left = duration::max();
    for (const auto& x : run.scenes) // in order
      if (x.station == station && x.at <= t)
        left = x.safe - gap - run_time;
    return left;
  };
  std::size_t used = 0, narrowed = 0;
  for (std::size_t k = 0; k < run.cycles.size(); k += 7) {
    const auto& x = run.cycles[k];
    if (!x.used || !x.session.is_remote())
      continue;
    ++used;
    const auto left = left_at(x.session.station, x.received);
    narrowed += left < cap;
    CHECK(left >= least);
    CHECK(x.received - x.created <= std::min<duration>(cap, left));
    CHECK(x.received - x.timing.input_at <= left);
  }
  CHECK(used > 100);
  CHECK(narrowed > 0);
  for (const auto& x : run.episodes)
    if (x.of == side::requester && x.because.starts_with("safe_response"))
      CHECK(x.reason == end_reason::released);
}

TEST_CASE("where the scene limits results in a chain, none is used that is "
          "older than the cap, or made of a look longer ago than the scene "
          "allows") {
  auto text = std::string{scene_limited};
  text.insert(text.find("[[service]]"), chain_before);
  text.insert(text.find("[network]"), offers_all);
  text.replace(text.find("250ms"), 5, "100ms"); // as scenes are older here
  text.replace(text.find("14.0"), 4, "18.0");
  const auto run = play(scenario::parse_scenario(
      text, std::filesystem::path{SOFOF_SOURCE_DIR} / "config/scene.toml", {}));
  CHECK(run.collisions.empty());
  // When that was sensed of which an input of planning was made.
  std::map<std::pair<station_id, time_point>, time_point> sensed;
  for (const auto& x : run.stages) { // in order
    const auto before = sensed.find({x.station, x.timing.input_at});
    sensed[{x.station, x.got}] =
        before != sensed.end() ? before->second : x.timing.input_at;
  }
  const service_name planning{"trajectory_planning"};
  std::map<service_name, std::size_t> used;
  std::size_t narrowed = 0;
  for (const auto& x : run.cycles) {
    if (!x.used || !x.session.is_remote())
      continue;
    ++used[x.session.service];
    if (x.session.service != planning || used[planning] % 7 != 0)
      continue;
    auto left = duration::max();
    for (const auto& scene : run.scenes) // in order
      if (scene.station == x.session.station && scene.at <= x.received
          && scene.service == planning)
        left = scene.safe - gap - run_time;
    narrowed += left < cap;
    CHECK(x.received - x.created <= cap);
    const auto of = sensed.find({x.session.station, x.timing.input_at});
    REQUIRE(of != sensed.end());
    CHECK(x.received - of->second <= left);
  }
  CHECK(used.size() == 3);
  CHECK(used[planning] > 100);
  CHECK(narrowed > 0);
}
