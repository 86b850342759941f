// Which rings of lanes are roundabouts, and that they never fill up.
#include "world/roads/roundabouts.hpp"

#include "tests/support/toy_drivers.hpp"
#include "tests/support/toy_roundabout.hpp"

#include <doctest/doctest.h>

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

TEST_CASE("a roundabout of equal ranks does not fill up, however many come") {
  town t{roundabout()};
  auto number = 0U;
  for (auto row = 0; row < 8; ++row)
    for (auto k = 0; k < 4; ++k) { // three quarters round
      std::vector<std::string> lanes{fmt::format("from {}", k),
                                     fmt::format("in {}", k)};
      for (auto i = 0; i < 3; ++i) {
        if (i > 0)
          lanes.push_back(fmt::format("past {}", (k + i) % 4));
        lanes.push_back(fmt::format("ring {}", (k + i) % 4));
      }
      lanes.push_back(fmt::format("out {}", (k + 3) % 4));
      lanes.push_back(fmt::format("to {}", (k + 3) % 4));
      const auto on = t.map.make_route("way", lanes, false);
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

} // namespace sofof::toy
