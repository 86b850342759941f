// Tests of finding lanes that lie upon each other.
#include "world/roads/lane_overlaps.hpp"

#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::world;

namespace {

std::vector<lane_overlap> found(point from, point to) {
  return lane_overlaps({"streets",
                        {},
                        {toy::straight("main", {0, 0}, {100, 0}),
                         toy::straight("b", from, to)}});
}

} // namespace

TEST_CASE("a lane that lies on another is found, in either direction") {
  const auto along = found({30, 0.5}, {80, 0.5});
  REQUIRE(along.size() == 1);
  CHECK(along[0].lane_a == 0);
  CHECK(along[0].lane_b == 1);
  CHECK(along[0].length_m == doctest::Approx(50).epsilon(0.1));
  CHECK(along[0].at.x_m == doctest::Approx(55).epsilon(0.1));
  CHECK_FALSE(along[0].oncoming);
  const auto against = found({80, 0.5}, {30, 0.5});
  REQUIRE(against.size() == 1);
  CHECK(against[0].oncoming);
}

TEST_CASE("lanes that cross, or lie beside each other, do not overlap") {
  CHECK(found({50, -50}, {50, 50}).empty());
  CHECK(found({20, -20}, {80, 20}).empty());
  CHECK(found({0, 3.5}, {100, 3.5}).empty());
}
