// Tests of finding bends that no car can follow.
#include "world/roads/sharp_bends.hpp"

#include "tests/support/near.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::world;
using sofof::test::near;

namespace {

constexpr double least_radius_m = 4.6;

/// A quarter of a circle between two straight lanes.
road_map map_with_bend(double radius_m) {
  lane bend = toy::straight("bend", {0, 0}, {1, 0});
  bend.centre.clear();
  for (auto k = 0; k <= 10; ++k) {
    const auto turn_rad = k * std::numbers::pi / 20;
    bend.centre.push_back({50 + radius_m * std::sin(turn_rad),
                           radius_m * (1 - std::cos(turn_rad))});
  }
  auto in = toy::straight("in", {0, 0}, {50, 0});
  in.next = {"bend"};
  bend.next = {"out"};
  return {"bend",
          {},
          {in, bend,
           toy::straight("out", {50 + radius_m, radius_m},
                         {50 + radius_m, radius_m + 50})}};
}

std::vector<sharp_bend> found(const road_map& map,
                              const std::vector<std::string>& lanes) {
  // Twice: a bend is told once.
  const std::vector routes{map.make_route("a", lanes, false),
                           map.make_route("b", lanes, false)};
  return sharp_bends(map, routes, least_radius_m);
}

} // namespace

TEST_CASE("a bend as wide as cars need is no sharp one, a tighter one is") {
  CHECK(found(map_with_bend(8), {"in", "bend", "out"}).empty());
  const auto tight = found(map_with_bend(3), {"in", "bend", "out"});
  REQUIRE(tight.size() == 1);
  CHECK(tight[0].lane == "bend");
  CHECK(tight[0].turn_rad == near(std::numbers::pi / 2, 0.05));
  CHECK(tight[0].radius_m < 3.5);
}

TEST_CASE("a corner within a lane is one sharp bend where it is") {
  lane corner = toy::straight("corner", {0, 0}, {40, 0});
  for (auto y_m = 4.0; y_m <= 40; y_m += 4)
    corner.centre.push_back({40, y_m});
  const road_map map{"corner", {}, {corner}};
  const auto bends = found(map, {"corner"});
  REQUIRE(bends.size() == 1);
  CHECK(bends[0].lane == "corner");
  CHECK(distance_m(bends[0].at, {40, 0}) < 1);
  CHECK(bends[0].turn_rad == near(std::numbers::pi / 2, 0.2));
}
