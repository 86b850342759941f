// Which rings of lanes are roundabouts, and that they never fill up.
#include "world/roads/roundabouts.hpp"

#include "tests/support/toy_drivers.hpp"
#include "tests/support/toy_roundabout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace sofof::toy {

using namespace world;

TEST_CASE(
    "the lanes of a ring are a roundabout, those to and from it are not") {
  const auto map = roundabout();
  const roundabouts all{map};
  REQUIRE(all.count() == 1);
  for (std::size_t i = 0; i < map.lanes().size(); ++i) {
    CAPTURE(map.lanes()[i].name);
    const auto& name = map.lanes()[i].name;
    CHECK((all.of(i) == 0)
          == (name.starts_with("ring") || name.starts_with("past")));
  }
  CHECK(all.most(0) == 5); // half of 100 m by 8.6 m
}

TEST_CASE("a way round a block is no roundabout, nor is a crossing") {
  CHECK(roundabouts{roundabout(40)}.count() == 0);
  CHECK(roundabouts{cross_roads()}.count() == 0);
}

namespace {

/// @returns a way from one street to another, both out of four.
route_ptr round_way(const road_map& map, int from, int quarters) {
  std::vector<std::string> lanes{fmt::format("from {}", from),
                                 fmt::format("in {}", from)};
  for (auto i = 0; i < quarters; ++i) {
    if (i > 0)
      lanes.push_back(fmt::format("past {}", (from + i) % 4));
    lanes.push_back(fmt::format("ring {}", (from + i) % 4));
  }
  lanes.push_back(fmt::format("out {}", (from + quarters) % 4));
  lanes.push_back(fmt::format("to {}", (from + quarters) % 4));
  return map.make_route("way", lanes, false);
}

} // namespace

TEST_CASE("a roundabout of equal ranks does not fill up, however many come") {
  town t{roundabout()};
  auto number = 0U;
  for (auto row = 0; row < 8; ++row)
    for (auto k = 0; k < 4; ++k) { // three quarters round
      const auto on = round_way(t.map, k, 3);
      auto r = make_rider(station_id{++number}, on, 0, 0);
      r.user.s_m = 66 - 9.0 * row;
      place(r.user);
      t.riders.emplace_back(std::move(r));
    }
  constexpr auto minutes = 1200;
  for (auto i = 0; i < 8 * minutes && !t.riders.empty(); ++i)
    t.step();
  CHECK(t.riders.empty());
  CHECK(t.collisions == 0);
}

TEST_CASE("who waits before a full roundabout gets on to it, however many come "
          "from elsewhere") {
  town t{roundabout()};
  constexpr auto minutes = 1200;
  constexpr station_id waiting{1000};
  station_id::rep number = 0;
  const auto is_there = [&] {
    return std::ranges::any_of(
        t.riders, [&](const auto& r) { return r.user.station == waiting; });
  };
  const std::array ways{round_way(t.map, 2, 4), round_way(t.map, 1, 4),
                        round_way(t.map, 0, 1)};
  const auto has_place = [&](const route_ptr& way) {
    return std::ranges::none_of(t.riders, [&](const auto& r) {
      return r.user.on == way && r.user.s_m < 14;
    });
  };
  const auto stream = [&](int steps, auto until) {
    auto i = 0;
    for (; i < steps && !until(); ++i) {
      for (const auto& way : ways)
        if (i % 80 == 0 && has_place(way))
          t.riders.push_back(make_rider(station_id{++number}, way, 2, 4));
      t.step();
    }
    return i;
  };
  stream(2 * minutes, [] { return false; });
  auto r = make_rider(waiting, round_way(t.map, 3, 2), 0, 0);
  r.user.s_m = 66;
  place(r.user);
  t.riders.emplace_back(std::move(r));
  CHECK(stream(2 * minutes, [&] { return !is_there(); }) < 1.2 * minutes);
  CHECK(t.collisions == 0);
}

} // namespace sofof::toy
