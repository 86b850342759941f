// Who is told to wait, who is listed, and who touches whom.
#include "world/traffic/traffic.hpp"

#include "base/random.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/world/toy_user.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace sofof::toy {

using namespace world;

TEST_CASE("who has just come must not move before the first update") {
  const auto map = cross_roads();
  traffic all{map};
  all.report(user(1, make_route(map, {3, 0, 1}), 20));
  CHECK(all.perceive(1).stop_at_m == 20 + front_m);
  all.update({});
  CHECK(all.perceive(1).stop_at_m.value_or(1e300) > 100);
}

TEST_CASE("where crossings are not granted nobody is told to wait") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  const auto north = make_route(map, {4, 0, 2});
  for (const auto granted : {true, false}) {
    CAPTURE(granted);
    traffic all{map, {}, granted};
    all.report(user(1, east, east->start_of_m(1) - 6));
    all.report(user(2, north, north->start_of_m(1) - 6));
    all.report(user(3, north, north->start_of_m(1) - 20));
    for (auto t = 0; t < 3; ++t)
      all.update(time_point{std::chrono::seconds{t}});
    CHECK_FALSE(all.perceive(1).stop_at_m); // goes first
    CHECK(all.perceive(2).stop_at_m.has_value() == granted);
    CHECK(all.perceive(3).stop_at_m.has_value() == granted);
  }
}

TEST_CASE("who is gone is neither listed nor asked") {
  const auto map = cross_roads();
  const auto east = make_route(map, {3, 0, 1});
  traffic all{map};
  all.report(user(1, east, 20));
  all.report(user(2, east, 60));
  all.update({});
  CHECK(all.bodies().size() == 2);
  all.remove(2);
  all.remove(2);
  all.update({});
  REQUIRE(all.bodies().size() == 1);
  CHECK(all.bodies()[0].id == 1);
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
  for (station_id::rep i = 1; i <= 60; ++i) {
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

} // namespace sofof::toy
