// The occluded crossing: who sees whom from where, and what its options do.
#include "experiments/torture/changed_service.hpp"
#include "scenario/load.hpp"
#include "scenario/placement.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr station_id ego = 1, other = 2;
constexpr auto speed_mps = 13.89;

/// If both kept their speed, the other would be at the crossing point so much
/// later at most for both to be on the conflict's stretch at once, s.
constexpr auto latest_s = 0.8;

scenario_definition load_crossing(std::vector<std::string> overrides = {}) {
  return load_scenario(SOFOF_SOURCE_DIR "/config/occluded_crossing.toml",
                       overrides);
}

/// The option that makes the other come later than the ego, or earlier.
std::string later_by(double lag_s) {
  return fmt::format("fleet.1.start_m={:.3f}", 30 - speed_mps * lag_s);
}

std::vector<track_record> tracks_of(const memory_sink& records,
                                    station_id station) {
  std::vector<track_record> found;
  for (const auto& t : records.tracks)
    if (t.ego.own.station == station)
      found.push_back(t);
  return found;
}

/// @returns whether a line of sight passes through a building.
bool is_hidden(point from, point to, const road_map& map) {
  const auto crosses = [&](point a, point b) {
    const auto side = [](point p, point q, point r) {
      return cross(q - p, r - p) > 0;
    };
    return side(from, to, a) != side(from, to, b)
           && side(a, b, from) != side(a, b, to);
  };
  return std::ranges::any_of(map.buildings(), [&](const building& house) {
    const auto& corners = house.corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (crosses(corners[i], corners[(i + 1) % corners.size()]))
        return true;
    return false;
  });
}

} // namespace

TEST_CASE("both start 120 m before the crossing point, at the speed limit") {
  const auto s = load_crossing();
  const auto placed = place_vehicles(s);
  REQUIRE(placed.size() == 2);
  const std::array<point, 2> starts{{{-120, 0}, {0, -120}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& v = placed[i];
    CHECK(v.way->path().at(v.start_s_m).at.x_m
          == doctest::Approx(starts[i].x_m));
    CHECK(v.way->path().at(v.start_s_m).at.y_m
          == doctest::Approx(starts[i].y_m));
    CHECK(v.way->limit_mps(v.start_s_m) == speed_mps);
    CHECK(s.fleets[v.fleet].start_speed_mps == speed_mps);
  }
}

TEST_CASE("the ego road gives way to the crossing road") {
  const auto s = load_crossing();
  const auto& map = s.world->map;
  REQUIRE(map.conflicts().size() == 1);
  const auto& c = map.conflicts().front();
  CHECK(c.how == conflict::kind::crossing);
  CHECK(map.lanes()[c.lane_a].name == "ego_road");
  CHECK(map.lanes()[c.lane_a].rank > map.lanes()[c.lane_b].rank);
  // At `latest_s` one comes onto the stretch as the other leaves it.
  const vehicle_params car;
  const auto stretch_m = c.to_a_m - c.from_a_m + car.front_m + car.rear_m;
  CHECK(stretch_m / speed_mps == doctest::Approx(latest_s).epsilon(0.02));
}

TEST_CASE("whatever the timing, the house hides the other until the ego is "
          "31 to 34 m before the crossing point") {
  const auto s = load_crossing();
  for (auto lag_s = -latest_s; lag_s <= latest_s; lag_s += latest_s / 100) {
    CAPTURE(lag_s);
    const auto sees = [&](double d_m) {
      return !is_hidden({-d_m, 0}, {0, -d_m - speed_mps * lag_s}, s.world->map);
    };
    auto d_m = 125.0;
    while (!sees(d_m))
      d_m -= 0.01;
    CHECK(d_m > 30.9);
    CHECK(d_m < 34.1);
    if (std::abs(lag_s) < 1e-9)
      CHECK(d_m == doctest::Approx(32).epsilon(0.001));
    for (; d_m > 0; d_m -= 0.1)
      CHECK(sees(d_m)); // and for good
  }
}

TEST_CASE("from the mast at the crossing both are seen all the time") {
  const auto s = load_crossing();
  for (auto d_m = -20.0; d_m < 140; d_m += 0.5) {
    CHECK_FALSE(is_hidden({4, 4}, {-d_m, 0}, s.world->map));
    CHECK_FALSE(is_hidden({4, 4}, {0, -d_m}, s.world->map));
  }
}

TEST_CASE("who starts driving does not brake before its first plan") {
  const auto records = play(load_crossing({"duration=1s"}));
  for (const auto station : {ego, other}) {
    auto lowest_mps2 = 0.0;
    auto steps = 0;
    for (const auto& t : tracks_of(records, station))
      if (t.plan_age == t.at - time_point{}) { // no other than the first
        lowest_mps2 = std::min(lowest_mps2, t.ego.own.accel_mps2);
        ++steps;
      }
    CHECK(steps > 4);
    CHECK(lowest_mps2 > -0.05);
  }
}

TEST_CASE("the ego is offloaded at once, the unconnected other never") {
  const auto records = play(load_crossing({"duration=3s"}));
  REQUIRE(records.episodes.size() == 2); // one for each side
  for (const auto& e : records.episodes) {
    CHECK(e.session.station == ego);
    CHECK(e.got_data);
    CHECK(e.first_data < time_point{1200ms}); // it is known for a second
  }
  for (const auto& e : records.events)
    CHECK(e.station != other);
  CHECK(tracks_of(records, other).size() > 250); // it drives all the same
}

TEST_CASE("connected, the other is offloaded too") {
  const auto records =
      play(load_crossing({"duration=3s", "fleet.1.connected=true"}));
  CHECK(records.episodes.size() == 4);
}

TEST_CASE("who never asks plans on board") {
  const auto records =
      play(load_crossing({"duration=3s", "policies.lodm=never"}));
  CHECK(records.episodes.empty());
}

TEST_CASE("services know whether crossings are granted") {
  for (const auto granted : {true, false}) {
    auto s = load_crossing({"duration=2s"});
    s.traffic.crossings = granted ? "granted" : "perceived";
    std::vector<bool> told;
    s.services = {std::make_shared<changed_service>(
        make_service_type("trajectory_planning"),
        [&](offloading::service&, const service_world& world) {
          told.push_back(world.crossings_granted);
        })};
    play(s);
    // In vehicles, and at the provider, which has sensors of its own.
    CHECK(told == std::vector{granted, granted});
  }
}

TEST_CASE("where crossings are granted nobody collides, whatever the timing") {
  for (auto lag_s = -latest_s; lag_s <= latest_s; lag_s += latest_s / 4) {
    CAPTURE(lag_s);
    const auto records =
        play(load_crossing({"traffic.crossings=granted", later_by(lag_s)}));
    CHECK(records.collisions.empty());
    const auto ends = tracks_of(records, ego);
    REQUIRE(!ends.empty());
    CHECK(ends.back().ego.own.position.x_m > 60);
  }
}
