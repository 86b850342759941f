// Whole runs in virtual time, judged by their records.
#include "actors/offloading/broadcast_listener.hpp"
#include "experiments/torture/changed_service.hpp"
#include "scenario/load.hpp"
#include "scenario/placement.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::experiments::torture;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace sofof::world;

namespace {

using namespace std::chrono_literals;

const std::string ulm_lehr = SOFOF_SOURCE_DIR "/config/ulm_lehr.toml";

memory_sink drive(const std::vector<std::string>& overrides) {
  return play(load_scenario(ulm_lehr, overrides));
}

/// What providers get to know, besides the real listener.
struct notebook final : broadcast_listener {
  std::size_t heard = 0, seen = 0;
  std::vector<point> where;
  std::shared_ptr<offloading::provider_service> real;

  void on_cam(const cam& c, sender_id from) override {
    ++heard;
    listener_of(*real)->on_cam(c, from);
  }
  void on_objects(const object_list& told, sender_id from) override {
    listener_of(*real)->on_objects(told, from);
    keep(told.objects);
  }
  void on_detections(const roadside_detections& view) override {
    listener_of(*real)->on_detections(view);
    keep(view.objects);
  }
  void keep(const std::vector<perceived_object>& objects) {
    ++seen;
    for (const auto& o : objects)
      where.push_back(o.centre);
  }
};

/// Planning at a provider that writes down what it gets to know.
struct watched_planning final : real_at_provider {
  std::shared_ptr<notebook> notes;
  watched_planning(std::shared_ptr<offloading::provider_service> real,
                   std::shared_ptr<notebook> into)
      : real_at_provider{real}, notes{std::move(into)} {
    notes->real = std::move(real);
  }
  broadcast_listener* listener() override { return notes.get(); }
};

service_type_ptr watched(std::shared_ptr<notebook> notes) {
  return std::make_shared<changed_service>(
      make_service_type("trajectory_planning"),
      [notes](offloading::service& planning, const service_world&) {
        planning.at_provider = [real = planning.at_provider,
                                notes](const auto& provider) {
          return std::make_shared<watched_planning>(real(provider), notes);
        };
      });
}

/// Latency of each remote trajectory of one station, by cycle.
std::map<std::uint64_t, duration> latencies(const memory_sink& records,
                                            station_id station) {
  std::map<std::uint64_t, duration> result;
  for (const auto& c : records.cycles)
    if (c.session.station == station
        && c.session.service == service_name{"trajectory_planning"})
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
      remote.insert(e.session.station);
  CHECK(remote.size() == 6);
}

TEST_CASE("a network that stalls makes vehicles fall back, never unsafe, and "
          "each service is judged on its own") {
  const auto records = drive({"duration=400s", "network.profile=cicv5g_n8"});
  check_safety(records);
  std::map<service_name, int> fallbacks;
  for (const auto& e : records.episodes)
    fallbacks[e.session.service] += e.fallback;
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
                                        "network.profile=cicv5g_n78"};
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

TEST_CASE("a provider that dies is left at once; when it is back, vehicles "
          "come again") {
  const auto records =
      drive({"duration=200s", "fleet.0.count=4", "provider.0.fails_at=60s",
             "provider.0.returns_at=90s", "provider.0.area_radius_m=2000",
             "policies.lodm=always", "policies.codm=always",
             "service.0.planner.name=lane_follow"});
  check_safety(records);
  std::set<provider_id> boots;
  auto lost = 0;
  for (const auto& e : records.episodes) {
    if (e.of != side::requester)
      continue;
    boots.insert(e.session.provider);
    if (e.reason != end_reason::peer_lost)
      continue;
    ++lost;
    CHECK(e.fallback);
    CHECK(e.ended == time_point{60s});
  }
  CHECK(lost == 8); // either service of each vehicle
  CHECK(boots == std::set<provider_id>{provider_at(1, 0), provider_at(1, 1)});
  for (const auto& c : records.cycles) {
    const auto t = c.received.time_since_epoch();
    CHECK((t <= 60s || t >= 90s));
    CHECK((c.session.provider == provider_at(1, 0)) == (t <= 60s));
  }
}

TEST_CASE("a vehicle whose computer dies comes to rest, and its provider ends "
          "what runs for it") {
  const auto records =
      drive({"duration=100s", "fleet.0.count=1", "fleet.0.fails_at=60s",
             "provider.0.area_radius_m=2000", "policies.lodm=always",
             "policies.codm=always", "service.0.planner.name=lane_follow"});
  CHECK(records.collisions.empty());
  auto freed = 0;
  for (const auto& e : records.episodes) {
    CHECK(e.of == side::provider); // nobody is there to close the other one
    CHECK(e.ended >= time_point{60s});
    CHECK(e.ended <= time_point{65s});
    ++freed;
  }
  CHECK(freed == 2); // services
  REQUIRE_FALSE(records.tracks.empty());
  CHECK(records.tracks.back().at > time_point{99s});
  CHECK(records.tracks.back().ego.own.speed_mps == 0);
}

TEST_CASE("vehicles appear over time, and never on each other") {
  const auto s = load_scenario(
      ulm_lehr,
      std::vector<std::string>{
          "duration=120s", "fleet.0.count=12", "fleet.0.placement=convoy",
          "fleet.0.spacing_m=0", "fleet.0.start_m=100",
          "fleet.0.appear_every=5s", "service.0.planner.name=lane_follow"});
  const auto records = play(s);
  check_safety(records);
  std::map<station_id, time_point> appeared;
  for (const auto& e : records.events)
    if (e.what == event_type::appeared)
      appeared[e.station] = e.at;
  CHECK(appeared.size() == 11); // but for the first, who is there
  for (const auto& [station, at] : appeared)
    CHECK(at >= time_point{(station.value() - 101) * 5s});
}

TEST_CASE("an obstacle of a scenario stands on its road") {
  auto s = load_scenario(ulm_lehr, std::vector<std::string>{"duration=1s"});
  REQUIRE(play(s).collisions.empty());
  const auto first = place_vehicles(s).front();
  s.obstacles.push_back({first.way->path().at(first.start_s_m).at});
  const auto records = play(s);
  REQUIRE(records.collisions.size() == 1);
  CHECK(records.collisions.front().first == first.station);
  CHECK(records.collisions.front().second == obstacle_id(0));
}

TEST_CASE("a provider knows of the CAMs and of what its sensors see") {
  auto s = load_scenario(
      ulm_lehr, std::vector<std::string>{"duration=10s", "v2x.cam=fixed_10hz",
                                         "v2x.cpm=off"});
  const auto written = std::make_shared<notebook>();
  s.services = {watched(written)};
  s.obstacles.push_back({{20, -30}});
  auto& sensors = s.providers.front().sensors;
  sensors = {{{0, 0}, 0, {.range_m = 40, .occlusion = false}}};
  play(s);
  const auto& notes = *written;
  CHECK(notes.heard > 6 * 90); // 10 Hz each, less what is under way
  CHECK(notes.seen >= 199);
  CHECK(notes.where.size() >= 199);
  for (const auto p : notes.where)
    CHECK(distance_m(p, {}) < 41);
  CHECK(distance_m(notes.where.front(), {20, -30}) < 1);
}
