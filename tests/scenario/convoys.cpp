// Vehicles that serve others.
#include "scenario/build.hpp"
#include "scenario/registry.hpp"
#include "tests/scenario/example.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;

namespace sofof::test::convoys {

using namespace std::chrono_literals;

const std::string convoy_file = SOFOF_SOURCE_DIR "/config/convoy.toml";

scenario_definition convoy(std::vector<std::string> overrides = {}) {
  overrides.emplace_back("service.0.planner.name=lane_follow");
  return load_scenario(convoy_file, overrides);
}

/// A fleet of the example with a table `provide`.
std::string riding(std::string_view provide) {
  return example::with("count = 6\nfirst_station = 101",
                       "count = 6\nfirst_station = 101\nprovide = { "
                           + std::string{provide} + " }");
}

/// @returns whether an error holds all of these.
bool says(const std::string& error, std::vector<std::string_view> words) {
  return !error.empty()
         && std::ranges::all_of(words, [&](std::string_view word) {
              return error.find(word) != error.npos;
            });
}

} // namespace sofof::test::convoys

using namespace sofof::test::convoys;

TEST_CASE("the first vehicle of a fleet is a provider, after those that "
          "stand") {
  const auto s = convoy();
  REQUIRE(s.providers.size() == 1);
  const auto& leader = s.providers.front();
  CHECK(leader.name == "leader");
  REQUIRE(leader.carrier);
  CHECK(leader.carrier->station == 101);
  CHECK(leader.position_m != point{});
  CHECK(leader.reach_m() < 600);
  CHECK(leader.reach_m() > 594);
  const auto both =
      load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml",
                    std::vector<std::string>{"fleet.0.provide.cars=all",
                                             "fleet.0.provide.name=car"});
  REQUIRE(both.providers.size() == 7);
  CHECK(both.providers[0].name == "mec");
  CHECK(both.providers[6].name == "car_106");
}

TEST_CASE("who drives a vehicle that provides runs its provider, and finds the "
          "one that stands without its name") {
  const auto both =
      load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml",
                    std::vector<std::string>{"fleet.0.provide.cars=first",
                                             "fleet.0.provide.name=car"});
  REQUIRE(both.providers.size() == 2);
  process_share here;
  here.provides = [](std::size_t) { return false; };
  here.drives = [&](station_id x) {
    return x == both.providers[1].carrier->station;
  };
  CHECK_FALSE(lives_here(both, here, 0));
  CHECK(lives_here(both, here, 1));
  here.drives = [](station_id) { return false; };
  CHECK_FALSE(lives_here(both, here, 1));
  drive_options unnamed;
  unnamed.registry.emplace();
  unnamed.providers.push_back({});
  CHECK(wanted_providers(both, unnamed).size() == 1);
}

TEST_CASE("a scenario with vehicles that provide is printed as it was "
          "written") {
  const auto s = convoy({"fleet.0.provide.services=[\"trajectory_planning\"]",
                         "fleet.0.provide.network.profile=ideal"});
  const auto text = to_toml(s);
  CHECK(text.find("[[provider]]") == text.npos);
  CHECK(text.find("name = \"leader\"") != text.npos);
  const auto again = parse_scenario(text, convoy_file, {});
  CHECK(to_toml(again) == text);
  CHECK(again.providers.size() == 1);
  CHECK(again.channel_to(0)->name == "ideal");
}

TEST_CASE("what says nothing of a provider on board is refused") {
  CHECK(says(example::error_of(riding("area_radius_m = 0")),
             {"area_radius_m", "from 1"}));
  CHECK(says(example::error_of(riding("position_m = [0, 0]")),
             {"position_m", "Known: "}));
  CHECK(says(example::error_of(riding("cars = \"last\"")), {"last", "first"}));
  CHECK(says(example::error_of(riding("name = \"\"")), {"name", "empty"}));
  CHECK(says(example::error_of(riding("name = \"mec\"")),
             {"two providers \"mec\""}));
  CHECK(says(example::error_of(riding("services = [\"parking\"]")),
             {"parking", "[[service]] here"}));
  CHECK(says(example::error_of(riding("services = []")), {"at least one"}));
  CHECK(says(example::error_of(riding("network = { profile = \"trace\" }")),
             {"trace"}));
  CHECK(says(example::error_of(example::with(
                 "connected = false", "connected = false\nprovide = {}")),
             {"provide", "not connected"}));
}

TEST_CASE("a leader serves those that follow it, and never itself") {
  const auto records = play(convoy({"duration=120s"}));
  CHECK(records.collisions.empty());
  std::map<station_id, duration> remote;
  for (const auto& e : records.episodes)
    if (e.of == side::requester && e.got_data)
      remote[e.session.station] += e.ended - e.first_data;
  CHECK(remote.size() == 5);
  CHECK_FALSE(remote.contains(101));
  for (const auto& [station, time] : remote) {
    CAPTURE(station);
    CHECK(time > 96s); // 80 %
  }
}

TEST_CASE("when the leader's computer dies, each follower's own function is "
          "there within the longest gap and 20 ms") {
  const auto s = convoy({"duration=70s", "fleet.0.fails_at=60s"});
  const auto lost = play(s);
  CHECK(lost.collisions.empty());
  std::set<station_id> left;
  for (const auto& e : lost.episodes)
    if (e.of == side::requester && e.reason == end_reason::peer_lost) {
      CHECK(e.ended == time_point{60s});
      left.insert(e.session.station);
    }
  CHECK(left.size() == 5);
  const auto limit = s.services.front()->options.limits.max_interarrival + 20ms;
  std::map<station_id, time_point> home; // the first own plan after that
  for (const auto& x : lost.stages)
    if (x.provider == provider_id{0} && x.got >= time_point{60s})
      home.try_emplace(x.station, x.got);
  for (const auto station : left) {
    CAPTURE(station);
    REQUIRE(home.contains(station));
    CHECK(home[station] <= time_point{60s} + limit);
  }
  for (const auto& x : lost.safety)
    if (x.station != 101)
      CHECK(x.without_fresh_plan == duration{});
}

TEST_CASE("who is served by a leader that arrives plans on its own at once") {
  const auto records =
      play(convoy({"duration=60s", "fleet.0.routes=[\"west_to_east\"]",
                   "fleet.1.routes=[\"west_to_east\"]"}));
  time_point arrived{};
  for (const auto& e : records.events)
    if (e.what == event_type::arrived && e.station == 101)
      arrived = e.at;
  REQUIRE(arrived > time_point{});
  std::set<station_id> left;
  for (const auto& e : records.episodes)
    if (e.of == side::provider) {
      CHECK(e.reason == end_reason::shutdown);
      CHECK(e.ended == arrived);
    } else {
      CHECK(e.ended == arrived);
      left.insert(e.session.station);
    }
  CHECK(left.size() == 5);
}
