// Who is ahead of whom.
#include "world/traffic/lane_order.hpp"

#include "tests/support/toy_streets.hpp"
#include "tests/world/toy_user.hpp"

#include <doctest/doctest.h>

namespace sofof::toy {

using namespace world;
namespace {

std::optional<leader> lead_of(station_id who, const road_map& map,
                              const std::vector<road_user>& users) {
  lane_users lanes{map};
  lanes.sort(users);
  return lanes.ahead_of(who);
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
  CHECK(lead_of(1, map, {user(1, east, 20), ahead})
        == leader{2, 60 - rear_m, 7});
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
  CHECK(lead->rear_m
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
    CHECK(lead->rear_m == doctest::Approx(3 * lap_m + 40 - rear_m));
  }
  SUBCASE("the leader is beyond the seam") {
    const auto lead = lead_of(
        1, map, {user(1, round, lap_m - 20), user(2, round, 5 * lap_m + 15)});
    REQUIRE(lead);
    CHECK(lead->rear_m == doctest::Approx(lap_m + 15 - rear_m));
  }
  SUBCASE("the leader's tail hangs over the seam") {
    const auto lead = lead_of(
        1, map, {user(1, round, lap_m - 20), user(2, round, lap_m + 0.5)});
    REQUIRE(lead);
    CHECK(lead->rear_m == doctest::Approx(lap_m + 0.5 - rear_m));
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
    CHECK(lead->rear_m == doctest::Approx(fork_m + 3 - rear_m));
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
  CHECK(lead->rear_m
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
  CHECK(lead->rear_m == doctest::Approx(connector_end_m(*east) - 5 - rear_m));
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
  CHECK(lead->rear_m > connector_end_m(*east) - 14 + front_m);
}

} // namespace sofof::toy
