// Who leads whom, and who touches whom.
#include "world/traffic.hpp"

#include "tests/support/toy_drivers.hpp"
#include "tests/support/toy_streets.hpp"
#include "world/random.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace sofof;
using namespace sofof::toy;

namespace {

constexpr auto front_m = 4.0175, rear_m = 1.0825;

road_user user(station_id station, route_ptr on, double s_m) {
  return make_rider(station, std::move(on), s_m).user;
}

/// Reports everybody, updates, and returns what `who` sees ahead.
std::optional<lead_vehicle> lead_of(station_id who, const road_map& map,
                                    std::initializer_list<road_user> users) {
  traffic all{map};
  for (const auto& u : users)
    all.report(u);
  all.update({});
  return all.perceive(who).lead;
}

/// Where the junction begins and ends on routes over it.
double connector_start_m(const route& r) {
  return r.start_of_m(1);
}
double connector_end_m(const route& r) {
  return r.start_of_m(2);
}

} // namespace

TEST_CASE("a follower sees the rear of who is ahead on its lane") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  auto ahead = user(2, east, 60);
  ahead.speed_mps = 7;
  ahead.accel_mps2 = -1;
  CHECK(lead_of(1, map, {user(1, east, 20), ahead})
        == lead_vehicle{2, 60 - rear_m, 7, -1});
  CHECK_FALSE(lead_of(2, map, {user(1, east, 20), ahead}));
}

TEST_CASE("the nearest of several leads, whatever their numbers") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto lead = lead_of(
      4, map, {user(9, east, 80), user(1, east, 60), user(4, east, 20)});
  REQUIRE(lead);
  CHECK(lead->station == 1);
}

TEST_CASE("a leader is seen over the lanes' ends, on the follower's own arc "
          "length") {
  const auto map = cross_roads();
  const auto straight_on = make_route(map, {3, 0, 1});
  const auto left_turn = make_route(map, {4, 0, 1}); // into the same street
  const auto lead =
      lead_of(1, map,
              {user(1, straight_on, connector_start_m(*straight_on) - 10),
               user(2, left_turn, connector_end_m(*left_turn) + 30)});
  REQUIRE(lead);
  CHECK(lead->rear_s_m
        == doctest::Approx(connector_end_m(*straight_on) + 30 - rear_m));
}

TEST_CASE("nobody is seen beyond two hundred metres") {
  const auto map = grid(4, 100);
  const auto way = make_route(map, {0, 1, 2, 3});
  CHECK(lead_of(1, map, {user(1, way, 2), user(2, way, 200)}));
  CHECK_FALSE(lead_of(1, map, {user(1, way, 2), user(2, way, 220)}));
}

TEST_CASE("laps count as the follower counts them") {
  const auto map = grid(2, 100);
  const auto round = make_route(map, {0, 1, 3, 2}, true);
  const auto lap_m = round->length_m();
  SUBCASE("the leader is in its first lap") {
    const auto lead =
        lead_of(1, map, {user(1, round, 3 * lap_m + 10), user(2, round, 40)});
    REQUIRE(lead);
    CHECK(lead->rear_s_m == doctest::Approx(3 * lap_m + 40 - rear_m));
  }
  SUBCASE("the leader is beyond the seam") {
    const auto lead = lead_of(
        1, map, {user(1, round, lap_m - 20), user(2, round, 5 * lap_m + 15)});
    REQUIRE(lead);
    CHECK(lead->rear_s_m == doctest::Approx(lap_m + 15 - rear_m));
  }
  SUBCASE("the leader's tail hangs over the seam") {
    const auto lead = lead_of(
        1, map, {user(1, round, lap_m - 20), user(2, round, lap_m + 0.5)});
    REQUIRE(lead);
    CHECK(lead->rear_s_m == doctest::Approx(lap_m + 0.5 - rear_m));
  }
}

TEST_CASE("nobody follows itself round a short block") {
  const auto map = grid(2, 50);
  const auto round = make_route(map, {0, 1, 3, 2}, true);
  REQUIRE(round->length_m() < 200);
  CHECK_FALSE(lead_of(1, map, {user(1, round, 10)}));
}

TEST_CASE("oncoming traffic and crossing streets lead nobody") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  CHECK_FALSE(
      lead_of(1, map,
              {user(1, east, 60), user(2, make_route(map, {1, 0, 3}), 60),
               user(3, make_route(map, {4, 0, 2}), 130)}));
}

TEST_CASE("who turns off leads as long as its body is in the way") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto left = make_route(map, {3, 0, 2});
  const auto follower = user(1, east, connector_start_m(*east) - 10);
  const auto fork_m = connector_start_m(*left);
  SUBCASE("at the fork") {
    const auto lead = lead_of(1, map, {follower, user(2, left, fork_m + 3)});
    REQUIRE(lead);
    CHECK(lead->rear_s_m == doctest::Approx(fork_m + 3 - rear_m));
  }
  SUBCASE("having left") {
    CHECK_FALSE(lead_of(1, map, {follower, user(2, left, fork_m + 15)}));
  }
}

TEST_CASE("a tail that hangs back over a fork is seen from the other branch") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto right = make_route(map, {3, 0, 4});
  // A lorry: its axle is in the side street, its rear still in the fork.
  auto lorry = user(2, right, connector_end_m(*right) + 2);
  lorry.rear_m = 14;
  const auto lead =
      lead_of(1, map, {user(1, east, connector_start_m(*east) + 1), lorry});
  REQUIRE(lead);
  CHECK(lead->rear_s_m
        == doctest::Approx(connector_start_m(*east) + connector_end_m(*right)
                           + 2 - 14 - connector_start_m(*right)));
}

TEST_CASE("of two side by side at a fork just one leads") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto left = make_route(map, {3, 0, 2});
  const auto a = user(1, east, connector_start_m(*east) + 1);
  const auto b = user(2, left, connector_start_m(*left) + 1);
  CHECK_FALSE(lead_of(1, map, {a, b}));
  CHECK(lead_of(2, map, {a, b}));
}

TEST_CASE("who is in the zone of a merge leads who waits before it") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto turn = make_route(map, {4, 0, 1}); // right, into the same street
  const auto turning = user(2, turn, connector_end_m(*turn) - 5);
  const auto lead =
      lead_of(1, map, {user(1, east, connector_start_m(*east) - 8), turning});
  REQUIRE(lead);
  CHECK(lead->station == 2);
  // As if it were on the own lane, as far from the end.
  CHECK(lead->rear_s_m == doctest::Approx(connector_end_m(*east) - 5 - rear_m));
  CHECK_FALSE(
      lead_of(2, map, {user(1, east, connector_start_m(*east) - 8), turning}));
}

TEST_CASE("a car that comes into a zone does not lead from behind the line") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto turn = make_route(map, {4, 0, 1});
  // Its front is in the zone, its tail as far back as the other's front.
  const auto lead = lead_of(1, map,
                            {user(1, east, connector_end_m(*east) - 14),
                             user(2, turn, connector_end_m(*turn) - 9)});
  REQUIRE(lead);
  CHECK(lead->rear_s_m > connector_end_m(*east) - 14 + front_m);
}

TEST_CASE("who has just come must not move before the first update") {
  const auto map = cross_roads();
  traffic all{map};
  all.report(user(1, make_route(map, {3, 0, 1}), 20));
  CHECK(all.perceive(1).stop_at_m == 20 + front_m);
  all.update({});
  CHECK(all.perceive(1).stop_at_m.value_or(1e300) > 100);
}

TEST_CASE("where crossings are not granted nobody is told to wait, but who "
          "leads is seen") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto north = make_route(map, {4, 0, 2});
  for (const auto granted : {true, false}) {
    CAPTURE(granted);
    traffic all{map, {}, granted};
    all.report(user(1, east, connector_start_m(*east) - 6));
    all.report(user(2, north, connector_start_m(*north) - 6));
    all.report(user(3, north, connector_start_m(*north) - 20));
    for (auto t = 0; t < 3; ++t)
      all.update(time_point{std::chrono::seconds{t}});
    CHECK_FALSE(all.perceive(1).stop_at_m); // goes first
    CHECK(all.perceive(2).stop_at_m.has_value() == granted);
    CHECK(all.perceive(3).stop_at_m.has_value() == granted);
    REQUIRE(all.perceive(3).lead);
    CHECK(all.perceive(3).lead->station == 2);
  }
}

TEST_CASE("who is gone is neither seen nor asked") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  traffic all{map};
  all.report(user(1, east, 20));
  all.report(user(2, east, 60));
  all.update({});
  CHECK(all.perceive(1).lead);
  all.remove(2);
  all.remove(2);
  all.update({});
  CHECK_FALSE(all.perceive(1).lead);
  CHECK_THROWS_AS(all.perceive(2), std::out_of_range);
}

TEST_CASE("bodies that touch are found, also of oncoming traffic") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto west = make_route(map, {1, 0, 3});
  traffic all{map};
  auto strayed = user(5, west, 200); // 76 m from the west
  strayed.body.centre.y_m -= 2;
  all.report(strayed);
  all.report(user(7, east, 76));
  all.report(user(3, east, 30));
  all.report(user(4, east, 34));
  all.report(user(8, west, 150)); // in its lane: passes
  all.report(user(9, east, 150));
  all.update({});
  using pairs = std::vector<std::pair<station_id, station_id>>;
  CHECK(all.collisions() == pairs{{3, 4}, {5, 7}});
  all.remove(4);
  CHECK(all.collisions().size() == 2); // as of the last update
  all.update({});
  CHECK(all.collisions() == pairs{{5, 7}});
}

TEST_CASE("touching bodies are those that a comparison of all pairs finds") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const random_stream dice{7, "heap"};
  traffic all{map};
  std::vector<road_user> users;
  for (station_id i = 1; i <= 60; ++i) {
    auto u = user(i, east, 10);
    u.body = {{dice.uniform(0, 60, i, 0), dice.uniform(0, 60, i, 1)},
              dice.uniform(0, 6, i, 2),
              dice.uniform(2, 14, i, 3),
              2};
    users.push_back(u);
    all.report(u);
  }
  all.update({});
  std::vector<std::pair<station_id, station_id>> expected;
  for (std::size_t a = 0; a < users.size(); ++a)
    for (auto b = a + 1; b < users.size(); ++b)
      if (overlap(users[a].body, users[b].body))
        expected.emplace_back(users[a].station, users[b].station);
  CHECK(expected.size() > 20);
  CHECK(all.collisions() == expected);
}

TEST_CASE("bodies are listed by their stations, then what stands there") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  traffic all{map, {{900, {{50, 50}, 0, 4, 2}}}};
  all.report(user(7, east, 20));
  all.report(user(3, east, 60));
  all.update({});
  const auto bodies = all.bodies();
  REQUIRE(bodies.size() == 3);
  CHECK(bodies[0].id == 3);
  CHECK(bodies[1].id == 7);
  CHECK(bodies[1].box.centre == user(7, east, 20).body.centre);
  CHECK(bodies[2].id == 900);
  CHECK(bodies[2].box.centre == point{50, 50});
}

TEST_CASE("what stands on the road can be hit, but is no road user") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto box = user(1, east, 20).body;
  traffic all{map, {{900, box}, {901, box}}};
  all.update({});
  CHECK(all.collisions().empty()); // they stand on each other
  CHECK_THROWS_AS(all.perceive(900), std::out_of_range);
  all.report(user(1, east, 20));
  all.update({});
  CHECK(all.collisions()
        == std::vector<std::pair<station_id, station_id>>{{1, 900}, {1, 901}});
  all.remove(1);
  all.update({});
  CHECK(all.collisions().empty());
}
