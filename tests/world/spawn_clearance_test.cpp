// Where vehicles may appear.
#include "world/traffic/spawn_clearance.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::world;

namespace {

road_body other(double x_m, double speed_mps) {
  return {7, {{x_m, 0}, 0, 5, 2}, speed_mps, 0};
}

bool free_beside(double x_m, double speed_mps, double own_mps = 0) {
  const std::vector others{other(x_m, speed_mps)};
  return is_free({{0, 0}, 0, 5, 2}, own_mps, others);
}

} // namespace

TEST_CASE("on an empty road every place is free") {
  CHECK(is_free({}, 30, {}));
}

TEST_CASE("nobody appears on somebody, or right beside") {
  CHECK_FALSE(free_beside(0, 0));
  CHECK_FALSE(free_beside(10, 0));
  CHECK(free_beside(13, 0));
}

TEST_CASE("who drives fast needs more room, on either side") {
  CHECK_FALSE(free_beside(-70, 13.89));
  CHECK(free_beside(-80, 13.89));
  CHECK_FALSE(free_beside(70, 0, 13.89));
  CHECK(free_beside(80, 0, 13.89));
}

TEST_CASE("who drives away is no danger, however fast it is") {
  CHECK_FALSE(free_beside(11, 13.89));
  CHECK(free_beside(13, 13.89));
  CHECK(free_beside(-13, 0, 13.89));
}

TEST_CASE("who drives across may come nearer and counts as coming") {
  const auto beside = [](double heading_rad) {
    const std::vector others{road_body{7, {{0, 30}, heading_rad, 5, 2}, 10, 0}};
    return is_free({{0, 0}, 0, 5, 2}, 0, others);
  };
  CHECK_FALSE(beside(0));
  CHECK_FALSE(beside(-1.57));
  CHECK(beside(1.57));
}

TEST_CASE("one is enough to be in the way") {
  const std::vector others{other(500, 10), other(5, 0), other(900, 3)};
  CHECK_FALSE(is_free({{0, 0}, 0, 5, 2}, 0, others));
}
