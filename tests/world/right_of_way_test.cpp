// Whose turn it is at crossings: the rules, one by one, and that nobody ever
// touches anybody or waits for ever.
#include "base/random.hpp"
#include "tests/support/toy_drivers.hpp"
#include "tests/support/toy_streets.hpp"
#include "world/roads/unrolled_route.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <set>

namespace sofof::toy {

using namespace world;
namespace {

constexpr auto minute = 1200; // steps

/// Adds a rider whose front is so far before the junction. The reference
/// holds until the next one comes.
rider& add(town& t, station_id station, std::vector<std::size_t> junctions,
           double before_m, double speed_mps) {
  const auto on = make_route(t.map, junctions);
  auto r = make_rider(station, on, 0, speed_mps);
  r.user.s_m = on->start_of_m(1) - before_m - r.user.front_m;
  place(r.user);
  return t.riders.emplace_back(std::move(r));
}

/// @returns whether the rider may drive over the junction that it is before
/// or on.
bool may_cross(const town& t, const rider& r) {
  const auto stop_m = t.all.perceive(r.user.station).stop_at_m;
  return !stop_m || *stop_m > r.user.on->start_of_m(2);
}

bool has_crossed(const rider& r) {
  return r.user.s_m - r.user.rear_m > r.user.on->start_of_m(2);
}

/// @returns the stations in the order in which they come out of the junction.
std::vector<station_id> order_of_crossing(town& t, int steps = 2 * minute) {
  std::vector<station_id> order;
  for (int i = 0; i < steps; ++i) {
    t.step();
    for (const auto& r : t.riders)
      if (has_crossed(r) && std::ranges::count(order, r.user.station) == 0)
        order.push_back(r.user.station);
  }
  CHECK(t.collisions == 0);
  return order;
}

using stations = std::vector<station_id>;

} // namespace

TEST_CASE("nowhere there are no zones, on a round either") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  constexpr auto inf = std::numeric_limits<double>::infinity();
  const auto map = grid(3, 100);
  const unrolled_route round{make_route(map, {0, 1, 4, 3}, true),
                             list_encounters(map)};
  const auto count = [&](double from_m, double to_m) {
    auto zones = 0;
    round.for_zones(from_m, to_m, [&](const zone&) { return ++zones < 1000; });
    return zones;
  };
  CHECK(count(0, 400) > 0);
  CHECK(count(-400, 0) > 0);
  CHECK(count(0, inf) == 1000);
  for (const auto nowhere : {nan, inf, -inf})
    CHECK(count(nowhere, 0) == 0);
  for (const auto nowhere : {nan, -inf})
    CHECK(count(0, nowhere) == 0);
}

TEST_CASE("a crossing is closed from afar and open before one must brake") {
  town t{cross_roads()};
  add(t, 1, {3, 0, 1}, 110, limit_mps);
  t.step();
  CHECK_FALSE(may_cross(t, t.at(1)));
  auto slowest_mps = limit_mps;
  while (!has_crossed(t.at(1))) {
    t.step();
    slowest_mps = std::min(slowest_mps, t.at(1).user.speed_mps);
  }
  CHECK(slowest_mps > limit_mps - 0.1);
}

TEST_CASE("nobody is let on to the main road in front of others") {
  town t{cross_roads()};
  add(t, 1, {4, 0, 2}, 2, 0);
  add(t, 2, {3, 0, 1}, 50, limit_mps);
  CHECK(order_of_crossing(t) == stations{2, 1});
}

TEST_CASE("who gives way goes when there is time enough") {
  town t{cross_roads()};
  add(t, 1, {4, 0, 2}, 2, 0);
  add(t, 2, {3, 0, 1}, 130, limit_mps);
  CHECK(order_of_crossing(t) == stations{1, 2});
}

TEST_CASE("left turns give way to oncoming traffic") {
  town t{cross_roads()};
  add(t, 1, {3, 0, 2}, 20, 8);
  add(t, 2, {1, 0, 3}, 30, 8);
  CHECK(order_of_crossing(t) == stations{2, 1});
}

TEST_CASE("right turns of both directions go together") {
  town t{cross_roads()};
  add(t, 1, {3, 0, 4}, 1, 0);
  add(t, 2, {1, 0, 2}, 1, 0);
  t.step();
  CHECK(may_cross(t, t.at(1)));
  CHECK(may_cross(t, t.at(2)));
}

TEST_CASE("among equals the first to come goes first") {
  town t{cross_roads(true)};
  add(t, 2, {3, 0, 1}, 30, 6);
  add(t, 1, {4, 0, 2}, 45, 6);
  CHECK(order_of_crossing(t) == stations{2, 1});
}

TEST_CASE("among equals that wait the first to come goes first") {
  town t{cross_roads(true)};
  add(t, 9, {3, 0, 2}, 0, 2).top_mps = 2; // in the way of both
  t.step();
  add(t, 2, {4, 0, 2}, 20, 6);
  add(t, 1, {1, 0, 3}, 40, 6);
  CHECK(order_of_crossing(t) == stations{9, 2, 1});
}

TEST_CASE("among equals that come together the lower number goes first") {
  for (const auto first : {1U, 2U}) {
    town t{cross_roads(true)};
    add(t, first, {3, 0, 1}, 2, 0);
    add(t, 3 - first, {4, 0, 2}, 2, 0);
    CHECK(order_of_crossing(t) == stations{1, 2});
  }
}

TEST_CASE("four that come together from four sides all get through") {
  town t{cross_roads(true)};
  add(t, 4, {1, 0, 4}, 2, 0);
  add(t, 2, {2, 0, 1}, 2, 0);
  add(t, 3, {3, 0, 2}, 2, 0);
  add(t, 1, {4, 0, 3}, 2, 0);
  CHECK(order_of_crossing(t).size() == 4);
}

TEST_CASE("nobody is let through behind somebody who waits") {
  town t{cross_roads()};
  add(t, 1, {4, 0, 3}, 2, 0);  // left: waits for the one from the north
  add(t, 2, {4, 0, 1}, 10, 0); // right: free, but behind
  add(t, 3, {3, 0, 1}, 40, limit_mps);
  t.step();
  CHECK_FALSE(may_cross(t, t.at(1)));
  CHECK_FALSE(may_cross(t, t.at(2)));
}

TEST_CASE("a convoy crosses without a break") {
  town t{cross_roads()};
  for (station_id::rep i = 1; i <= 3; ++i)
    add(t, i, {3, 0, 1}, 15.0 * i, 8);
  t.step();
  for (station_id::rep i = 1; i <= 2; ++i)
    CHECK(may_cross(t, t.at(i)));
}

TEST_CASE("who turns off into a full street holds up nobody behind") {
  town t{cross_roads(true)};
  add(t, 3, {3, 0, 4}, -35, 0).top_mps = 0; // room for one more before it
  add(t, 1, {3, 0, 4}, -3, 3);
  add(t, 2, {3, 0, 1}, 5, 3);
  t.step();
  CHECK(may_cross(t, t.at(1)));
  CHECK(may_cross(t, t.at(2)));
}

TEST_CASE("nobody stops on a junction to wait for the next") {
  // Two junctions, 0 and 1, with two metres of street between them.
  town t{build({{{0, 0}, {26, 0}, {-150, 0}, {176, 0}, {0, 150}, {26, 150}},
                {{2, 0}, {0, 1}, {1, 3}, {0, 4}, {1, 5}}})};
  add(t, 1, {5, 1, 3}, -6, 0).top_mps = 0; // broken down on junction 1
  add(t, 2, {2, 0, 1, 5}, 30, 8);
  for (int i = 0; i < minute / 2; ++i)
    t.step();
  const auto& first = *std::ranges::find_if(
      t.map.conflicts(), [&](const auto& c) { // the only one on its first half
        return t.map.lanes()[c.lane_a].name == "2>0>1"
               && t.map.lanes()[c.lane_b].name == "4>0>1";
      });
  const auto way_m =
      t.at(2).user.on->start_of_m(1) + first.from_a_m - t.at(2).front_m();
  CHECK(way_m > 0);
  CHECK(way_m < 1);
  t.at(1).top_mps = limit_mps;
  for (int i = 0; i < minute; ++i)
    t.step();
  CHECK(t.riders.empty());
  CHECK(t.collisions == 0);
}

TEST_CASE("a zone is kept until the rear has left it, and no longer") {
  town t{cross_roads(true)};
  add(t, 1, {3, 0, 1}, 1, 5);
  add(t, 2, {4, 0, 2}, 2, 0);
  const auto lane = [&](std::size_t i) { return t.map.lanes()[i].name; };
  const auto& c = *std::ranges::find_if(t.map.conflicts(), [&](const auto& x) {
    return lane(x.lane_a) == "3>0>1" && lane(x.lane_b) == "4>0>2";
  });
  const auto end_m = t.at(1).user.on->start_of_m(1) + c.to_a_m;
  auto rear_m = 0.0; // where it was when the update was made
  do {
    rear_m = t.at(1).user.s_m - t.at(1).user.rear_m;
    t.step();
  } while (!may_cross(t, t.at(2)));
  CHECK(rear_m >= end_m);
  CHECK(rear_m < end_m + 1);
}

TEST_CASE("what has been granted is not taken away") {
  town t{cross_roads()};
  add(t, 2, {4, 0, 2}, 2, 0);
  t.step();
  REQUIRE(may_cross(t, t.at(2)));
  add(t, 1, {3, 0, 1}, 30, limit_mps); // out of nowhere, on the main road
  t.at(2).top_mps = 1;
  t.step();
  CHECK_FALSE(may_cross(t, t.at(1)));
  while (!has_crossed(t.at(2))) {
    t.step();
    REQUIRE(may_cross(t, t.at(2)));
  }
  CHECK(t.collisions == 0);
}

TEST_CASE("who stands for long before what was granted gives it back") {
  town t{cross_roads()};
  add(t, 2, {4, 0, 2}, 2, 0);
  t.step();
  REQUIRE(may_cross(t, t.at(2)));
  t.at(2).top_mps = 0; // it sees something behind the junction
  add(t, 1, {3, 0, 1}, 30, limit_mps);
  constexpr auto steps_in_4_s = 80;
  for (int i = 0; i < steps_in_4_s; ++i) {
    t.step();
    REQUIRE(may_cross(t, t.at(2)));
    REQUIRE_FALSE(may_cross(t, t.at(1)));
  }
  for (int i = 0; i < minute && !has_crossed(t.at(1)); ++i)
    t.step();
  CHECK(has_crossed(t.at(1)));
  t.at(2).top_mps = limit_mps;
  for (int i = 0; i < minute && !has_crossed(t.at(2)); ++i)
    t.step();
  CHECK(has_crossed(t.at(2)));
  CHECK(t.collisions == 0);
}

TEST_CASE("nobody enters a junction without room behind it, and nobody waits "
          "for one who cannot enter") {
  town t{cross_roads()};
  add(t, 1, {3, 0, 1}, -28, 0).top_mps = 0; // broken down just behind it
  add(t, 2, {3, 0, 1}, 2, 0);
  add(t, 3, {4, 0, 2}, 2, 0);
  for (int i = 0; i < minute / 4; ++i)
    t.step();
  CHECK_FALSE(may_cross(t, t.at(2)));
  CHECK(has_crossed(t.at(3)));
  t.at(1).top_mps = limit_mps;
  CHECK(order_of_crossing(t) == stations{3, 1, 2});
}

TEST_CASE("when a full street has room again the right of way holds again") {
  town t{cross_roads()};
  add(t, 9, {3, 0, 1}, -31, 0).top_mps = 0;
  add(t, 1, {4, 0, 1}, 2, 0);
  add(t, 2, {3, 0, 1}, 2, 0);
  for (int i = 0; i < minute / 4; ++i)
    t.step();
  t.at(9).top_mps = limit_mps;
  CHECK(order_of_crossing(t) == stations{9, 2, 1});
}

TEST_CASE("whoever has waited for long gets through an endless stream") {
  town t{cross_roads()};
  station_id::rep next = 1;
  const auto stream = [&](int steps, auto until) {
    auto step = 0;
    for (; step < steps && !until(); ++step) {
      if (step % 80 == 0)
        t.riders.push_back(
            make_rider(next++, make_route(t.map, {3, 0, 1}), 2, limit_mps));
      t.step();
    }
    return step;
  };
  stream(minute / 2, [] { return false; });
  add(t, 1000, {4, 0, 2}, 2, 0);
  const auto waited =
      stream(2 * minute, [&] { return has_crossed(t.at(1000)); });
  CHECK(waited > minute / 3); // the stream has the right of way
  CHECK(waited < minute);
  CHECK(t.collisions == 0);
}

TEST_CASE("on random ways over a junction nobody touches and all arrive") {
  for (const auto equal : {false, true})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      CAPTURE(equal);
      CAPTURE(seed);
      town t{cross_roads(equal)};
      const random_stream dice{seed, "crossing"};
      std::array<double, 5> free_m{0, 120, 120, 120, 120};
      for (station_id::rep i = 1; i <= 24; ++i) {
        const auto from = 1 + dice.bits(i, 0) % 4;
        const auto to = 1 + (from + dice.bits(i, 1) % 3) % 4;
        free_m[from] -= dice.uniform(8, 24, i, 2);
        if (free_m[from] < 2)
          continue;
        auto r = make_rider(i, make_route(t.map, {from, 0, to}), free_m[from]);
        r.top_mps = dice.uniform(5, 10, i, 3);
        r.gap_m = dice.uniform(1.5, 3, i, 4);
        r.stops_at_m = dice.uniform(0, 0.9, i, 5);
        r.late = dice.bits(i, 6) % 10; // perceptions up to 0.45 s old
        t.riders.push_back(std::move(r));
      }
      REQUIRE(t.riders.size() > 10);
      for (int i = 0; i < 3 * minute && !t.riders.empty(); ++i)
        t.step();
      CHECK(t.riders.empty());
      CHECK(t.collisions == 0);
    }
}

namespace {

/// Fills a grid of 3 x 3 junctions: everybody drives round some blocks, for
/// ever.
town crowded_grid(std::uint64_t seed, std::size_t count) {
  town t{grid(3, 70)};
  const random_stream dice{seed, "grid"};
  std::map<std::vector<std::size_t>, route_ptr> routes;
  std::set<std::pair<std::size_t, std::size_t>> taken;
  for (std::uint64_t i = 0; t.riders.size() < count; ++i) {
    const auto left = dice.bits(i, 0) % 2, low = dice.bits(i, 1) % 2;
    const auto right = left + 1 + dice.bits(i, 2) % (2 - left);
    const auto top = low + 1 + dice.bits(i, 3) % (2 - low);
    std::vector<std::size_t> way;
    for (auto x = left; x < right; ++x)
      way.push_back(3 * low + x);
    for (auto y = low; y < top; ++y)
      way.push_back(3 * y + right);
    for (auto x = right; x > left; --x)
      way.push_back(3 * top + x);
    for (auto y = top; y > low; --y)
      way.push_back(3 * y + left);
    if (dice.bits(i, 4) % 2 == 0)
      std::ranges::reverse(way);
    auto& on = routes[way];
    if (!on)
      on = make_route(t.map, way, true);
    const auto street = 2 * (dice.bits(i, 5) % way.size());
    const auto slot = dice.bits(i, 6) % 5;
    if (!taken.emplace(on->sequence()[street], slot).second)
      continue;
    auto r =
        make_rider(static_cast<station_id>(t.riders.size() + 1), on,
                   on->start_of_m(street) + 2 + 8 * static_cast<double>(slot));
    r.top_mps = dice.uniform(6, 10, i, 7);
    r.gap_m = dice.uniform(1.5, 3, i, 8);
    r.late = dice.bits(i, 9) % 10;
    t.riders.push_back(std::move(r));
  }
  return t;
}

/// @returns how far the slowest has come.
double slowest_m(town& t, int steps) {
  std::vector<double> start_m;
  for (const auto& r : t.riders)
    start_m.push_back(r.user.s_m);
  for (int i = 0; i < steps; ++i)
    t.step();
  auto least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < t.riders.size(); ++i)
    least_m = std::min(least_m, t.riders[i].user.s_m - start_m[i]);
  return least_m;
}

} // namespace

TEST_CASE("in a crowded grid nobody is stuck, though the blocks are full") {
  for (const auto count : {40U, 84U}) { // of 120 places to stand
    CAPTURE(count);
    auto t = crowded_grid(count, count);
    slowest_m(t, 3 * minute);
    CHECK(slowest_m(t, 2 * minute) > 20);
    CHECK(t.collisions == 0);
  }
}

TEST_CASE("a full ring round a block turns on") {
  // Everybody turns left at every corner; each street is full and leads into
  // the next. One corner is just a bend, and full as well.
  town t{grid(3, 70)};
  const auto round = make_route(t.map, {0, 1, 4, 3}, true);
  station_id::rep next = 1;
  for (const auto& [leg, cars] : {std::pair{0U, 6}, {2U, 6}, {4U, 6}, {6U, 8}})
    for (int i = 0; i < cars; ++i) {
      t.riders.push_back(
          make_rider(next++, round, round->start_of_m(leg) + 1.5 + 8.2 * i));
      t.riders.back().gap_m = 3;
    }
  CHECK(slowest_m(t, 5 * minute) > 200);
  CHECK(t.collisions == 0);
}

TEST_CASE("the order of the reports changes nothing") {
  auto a = crowded_grid(5, 50), b = crowded_grid(5, 50);
  for (int i = 0; i < minute; ++i) {
    a.step();
    b.step(true);
  }
  for (std::size_t i = 0; i < a.riders.size(); ++i) {
    CHECK(a.riders[i].user.s_m == b.riders[i].user.s_m);
    CHECK(a.riders[i].seen.back() == b.riders[i].seen.back());
  }
}

} // namespace sofof::toy
