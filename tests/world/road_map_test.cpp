// Lanes, how they follow and meet each other, and routes over them.
#include "world/roads/road_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace sofof;
using namespace sofof::world;

namespace {

lane make_lane(std::string name, std::vector<point> centre,
               std::vector<std::string> next = {}) {
  return {std::move(name), std::move(centre), 1.75, {{0, 10}}, std::move(next)};
}

/// A street from west to east, one back 3.5 m beside it, and one from the
/// south that meets both at x = 50; from there one can turn right.
road_map village_map() {
  auto east_b = make_lane("east_b", {{40, 0}, {60, 0}}, {"east_c"});
  auto turn =
      make_lane("turn", {{50, -10}, {51, -5}, {54, -1.5}, {60, 0}}, {"east_c"});
  auto cross = make_lane("cross", {{50, -10}, {50, 0}, {50, 15}});
  cross.limits = {{0, 8}, {12, 14}};
  return {"village",
          {},
          {make_lane("east_a", {{0, 0}, {40, 0}}, {"east_b"}), east_b,
           make_lane("east_c", {{60, 0}, {100, 0}}),
           make_lane("west", {{100, 3.5}, {0, 3.5}}),
           make_lane("south", {{50, -60}, {50, -10}}, {"cross", "turn"}), cross,
           turn}};
}

std::vector<conflict> between(const road_map& map, std::string_view a,
                              std::string_view b) {
  std::vector<conflict> found;
  for (const auto& c : map.conflicts()) {
    const auto& name_a = map.lanes()[c.lane_a].name;
    const auto& name_b = map.lanes()[c.lane_b].name;
    if ((name_a == a && name_b == b) || (name_a == b && name_b == a))
      found.push_back(c);
  }
  return found;
}

using names = std::vector<std::string>;

} // namespace

TEST_CASE("a street across another is in conflict with it where they cross") {
  const auto map = village_map();
  const auto found = between(map, "west", "cross");
  REQUIRE(found.size() == 1);
  const auto& c = found[0];
  CHECK(c.how == conflict::kind::crossing);
  CHECK(c.lane_a < c.lane_b);
  // Lane a is "west", which passes x = 50 after 50 m; "cross" is 13.5 m long
  // there.
  CHECK(c.from_a_m <= 50 - 2.4);
  CHECK(c.from_a_m > 50 - 5);
  CHECK(c.to_a_m >= 50 + 2.4);
  CHECK(c.to_a_m < 50 + 5);
  CHECK(c.from_b_m <= 13.5 - 2.4);
  CHECK(c.from_b_m > 13.5 - 5);
  CHECK(c.to_b_m > 13.5 + 2.4);
  CHECK(c.to_b_m < 13.5 + 5);
}

TEST_CASE("lanes that end in the same lane merge to their very end") {
  const auto map = village_map();
  const auto found = between(map, "east_b", "turn");
  REQUIRE(found.size() == 1);
  CHECK(found[0].how == conflict::kind::merge);
  CHECK(found[0].to_a_m == doctest::Approx(20));
  CHECK(found[0].from_a_m > 8);
}

TEST_CASE("lanes that begin in the same lane diverge from their beginning") {
  const auto map = village_map();
  const auto found = between(map, "cross", "turn");
  REQUIRE(found.size() == 1);
  CHECK(found[0].how == conflict::kind::diverge);
  CHECK(found[0].from_a_m == 0);
  CHECK(found[0].from_b_m == 0);
  CHECK(found[0].to_a_m < 15);
}

TEST_CASE("lanes side by side, and lanes in a row, are not in conflict") {
  const auto map = village_map();
  CHECK(between(map, "east_a", "west").empty());
  CHECK(between(map, "east_b", "west").empty());
  CHECK(between(map, "east_a", "east_b").empty());
  CHECK(between(map, "south", "cross").empty());
  CHECK(between(map, "turn", "west").empty());
}

TEST_CASE("lanes that cross twice have two conflicts") {
  const road_map map{
      "bow",
      {},
      {make_lane("straight", {{0, 0}, {100, 0}}),
       make_lane("bow", {{20, -20}, {30, 0}, {50, 15}, {70, 0}, {80, -20}})}};
  REQUIRE(map.conflicts().size() == 2);
  CHECK(map.conflicts()[0].to_a_m < 40);
  CHECK(map.conflicts()[1].from_a_m > 60);
}

TEST_CASE("every pair of points that close belongs to a conflict") {
  const auto map = village_map();
  const auto lanes = map.lanes();
  for (std::size_t a = 0; a < lanes.size(); ++a)
    for (auto b = a + 1; b < lanes.size(); ++b) {
      if (std::ranges::count(lanes[a].next, lanes[b].name)
          || std::ranges::count(lanes[b].next, lanes[a].name))
        continue;
      const path on_a{lanes[a].centre}, on_b{lanes[b].centre};
      auto missed = 0;
      for (auto s = 0.0; s < on_a.length_m(); s += 0.1)
        for (auto t = 0.0; t < on_b.length_m(); t += 0.1) {
          if (distance_m(on_a.at(s).at, on_b.at(t).at) > meeting_distance_m)
            continue;
          missed +=
              std::ranges::none_of(map.conflicts(), [&](const conflict& c) {
                return c.lane_a == a && c.lane_b == b && c.from_a_m <= s
                       && s <= c.to_a_m && c.from_b_m <= t && t <= c.to_b_m;
              });
        }
      CHECK(missed == 0);
    }
}

TEST_CASE("a broken map is refused") {
  auto refused = [](std::vector<lane> lanes) {
    CHECK_THROWS_AS((road_map{"broken", {}, std::move(lanes)}),
                    std::invalid_argument);
  };
  refused({make_lane("a", {{0, 0}})});
  refused({make_lane("a", {{0, 0}, {0, 0}})});
  refused({make_lane("a", {{0, 0}, {9, 0}}, {"b"})});
  refused({make_lane("a", {{0, 0}, {9, 0}}, {"b"}),
           make_lane("b", {{19, 0}, {29, 0}})});
  refused({make_lane("a", {{0, 0}, {9, 0}}), make_lane("a", {{0, 5}, {9, 5}})});
  auto slow = make_lane("a", {{0, 0}, {9, 0}});
  slow.limits = {{0, 0}};
  refused({slow});
  slow.limits = {};
  refused({slow});
  slow.limits = {{0, 5}, {4, 8}, {3, 9}};
  refused({slow});
}

TEST_CASE("a refusal names the lane") {
  CHECK_THROWS_WITH_AS(
      (road_map{"m", {}, {make_lane("a", {{0, 0}, {9, 0}}, {"b"})}}),
      "Lane 'a' leads to 'b', which is not on the map.", std::invalid_argument);
  const auto map = village_map();
  CHECK_THROWS_WITH_AS(map.make_route("r", names{"east_a", "nowhere"}, false),
                       "Route 'r': lane 'nowhere' is not on the map.",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(map.make_route("r", names{"east_a", "turn"}, false),
                       "Route 'r': lane 'turn' does not follow 'east_a'.",
                       std::invalid_argument);
  CHECK_THROWS_AS(map.make_route("r", names{"east_a", "east_b"}, true),
                  std::invalid_argument);
  CHECK_THROWS_AS(map.make_route("r", {}, false), std::invalid_argument);
}

TEST_CASE("a route knows its lanes, limits and widths by arc length") {
  const auto map = village_map();
  const auto way =
      map.make_route("straight on", names{"south", "cross"}, false);
  CHECK(way->length_m() == doctest::Approx(75));
  CHECK_FALSE(way->closed());
  CHECK(way->start_of_m(1) == doctest::Approx(50));
  CHECK(way->start_of_m(2) == doctest::Approx(75));
  const auto place = way->at_lane(57);
  CHECK(map.lanes()[place.lane].name == "cross");
  CHECK(place.s_m == doctest::Approx(7));
  CHECK(map.lanes()[way->at_lane(-5).lane].name == "south");
  CHECK(way->at_lane(500).s_m == doctest::Approx(25));
  CHECK(way->limit_mps(0) == 10);
  CHECK(way->limit_mps(51) == 8);
  CHECK(way->limit_mps(61.9) == 8);
  CHECK(way->limit_mps(62.1) == 14);
  CHECK(way->half_width_m(3) == 1.75);
}

TEST_CASE("on a closed route, laps do not matter") {
  const road_map map{
      "block",
      {},
      {make_lane("a", {{0, 0}, {20, -5}, {40, 0}, {45, 20}}, {"b"}),
       make_lane("b", {{45, 20}, {40, 40}, {20, 45}, {0, 40}, {-5, 20}, {0, 0}},
                 {"a"})}};
  const auto lap = map.make_route("lap", names{"a", "b"}, true);
  CHECK(lap->closed());
  CHECK(map.conflicts().empty());
  const auto lap_m = lap->length_m();
  for (const auto s_m : {1.0, 50.0, lap_m - 1})
    for (const auto laps : {-2, 1, 9}) {
      const auto once = lap->at_lane(s_m),
                 later = lap->at_lane(s_m + laps * lap_m);
      CHECK(once.lane == later.lane);
      CHECK(once.s_m == doctest::Approx(later.s_m));
    }
  const auto ahead = lap->waypoints(lap_m - 5, 20, 5);
  REQUIRE(ahead.size() == 5);
  CHECK(distance_m(ahead[1], {0, 0}) < 1e-3);
}

TEST_CASE("what bounds a way stays as it is on the stretch that they name") {
  const auto map = village_map();
  const auto way =
      map.make_route("straight on", names{"south", "cross"}, false);
  const auto before = way->bounds_at(51);
  CHECK(before.from_m == doctest::Approx(50));
  CHECK(before.to_m == doctest::Approx(62)); // where the next zone begins
  const road_map round{
      "ring",
      {},
      {make_lane("ring", {{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}},
                 {"ring"})}};
  for (const auto& on : {way, round.make_route("round", names{"ring"}, true)})
    for (double s_m = -20; s_m < 420; s_m += 0.7) {
      CAPTURE(s_m);
      const auto bounds = on->bounds_at(s_m);
      if (on->closed() || s_m < on->length_m())
        CHECK(bounds.apply_at(s_m));
      for (const auto share : {0.0, 0.5, 0.999}) {
        const auto then =
            on->bounds_at(s_m + share * (bounds.to_m - s_m - 1e-9));
        CHECK(then.limit_mps == bounds.limit_mps);
        CHECK(then.half_width_m == bounds.half_width_m);
      }
    }
}

TEST_CASE("waypoints go on to the end of an open route and stop there") {
  const auto map = village_map();
  const auto way = map.make_route("east", names{"east_a", "east_b"}, false);
  const auto ahead = way->waypoints(41, 300, 4);
  REQUIRE(ahead.size() == 6);
  CHECK(ahead.front().x_m == doctest::Approx(41));
  CHECK(ahead[1].x_m == doctest::Approx(45));
  CHECK(ahead.back().x_m == doctest::Approx(60));
  CHECK(way->waypoints(0, 8, 4).size() == 3);
}

TEST_CASE("near a lane means within the tolerance of its centre line") {
  const auto map = village_map();
  const auto is_near = [](const road_map& m, point p, double tolerance_m) {
    return m.near_lanes({&p, 1}, tolerance_m);
  };
  CHECK(is_near(map, {20, 0}, 0.1));
  CHECK(is_near(map, {20, -2}, 2.1));
  CHECK_FALSE(is_near(map, {20, -2}, 1.9));
  CHECK(is_near(map, {50, -40}, 0.1));
  CHECK_FALSE(is_near(map, {30, -30}, 10));
  CHECK(is_near(map, {30, -30}, 20.5));
  CHECK_FALSE(is_near(road_map{}, {0, 0}, 100));
}

TEST_CASE("a way is near lanes when each of its points is") {
  const auto map = village_map();
  const auto way =
      map.make_route("way", names{"south", "turn", "east_c"}, false)
          ->waypoints(0, 300, 5);
  for (const auto p : way) // the spline of the route cuts the corner a little
    CHECK(map.near_lanes({&p, 1}, 1));
  CHECK(map.near_lanes(way, 1));
  CHECK(map.near_lanes({}, 1));
  for (std::size_t i = 0; i < way.size(); ++i) {
    auto off = way;
    off[i] = off[i] + point{300, 300};
    CHECK_FALSE(map.near_lanes(off, 10));
    off[i].x_m = std::nan("");
    CHECK_FALSE(map.near_lanes(off, 10));
  }
  CHECK(map.near_lanes(std::vector<point>{way.rbegin(), way.rend()}, 1));
}
