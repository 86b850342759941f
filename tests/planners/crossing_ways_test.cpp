// Ways through crossings.
#include "planners/crossing/crossing_ways.hpp"

#include "tests/support/map_file.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>

using namespace sofof;
using namespace sofof::planners;

namespace {

/// A roundabout of four arms, each 110 m long.
struct roundabout {
  test::map_file file =
      test::read_map(SOFOF_SOURCE_DIR "/config/maps/roundabout.toml");
  world::vehicle_params car;
  crossing_ways ways{
      std::make_shared<const lane_network>(file.map), {{0, 0}, 80}, car};

  route_profile_ptr profile(const std::string& name) const {
    return std::make_shared<const route_profile>(file.route(name),
                                                 comfort_limits{});
  }
};

} // namespace

TEST_CASE("a roundabout is one crossing, however far its places are apart") {
  roundabout r;
  const auto back = r.profile("0_4");
  const auto at = r.ways.find(back, 60, 150);
  REQUIRE(at);
  const auto& way = r.ways[at->way];
  CHECK(way.is_round);
  // It is entered from one arm, and three more ones are passed.
  CHECK(way.leaves_m - way.enters_m > 80);
  CHECK_FALSE(r.ways.find(back, way.leaves_m + 1, 150));
}

TEST_CASE(
    "on a roundabout one follows the other, wherever each of them leaves") {
  roundabout r;
  const auto a = r.ways.find(r.profile("0_2"), 60, 150);
  const auto b = r.ways.find(r.profile("1_2"), 60, 150);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(r.ways[a->way].lane != r.ways[b->way].lane);
  CHECK(r.ways[a->way].out_lane != r.ways[b->way].out_lane);
  CHECK(r.ways.follow(a->way, b->way));
}
