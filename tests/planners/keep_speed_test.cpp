// A plan to begin with.
#include "planners/trajectory/keep_speed.hpp"

#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::now;

TEST_CASE("who keeps its speed stays in the middle of its lane, as fast as it "
          "was") {
  const auto way = test::oval({{0, 13.9}});
  for (const auto speed_mps : {0.0, 0.3, 13.9}) {
    CAPTURE(speed_mps);
    const auto plan = keep_speed(*way, now, 270, speed_mps);
    REQUIRE(plan.is_sound());
    CHECK(plan.start == now);
    CHECK(to_seconds(plan.end() - now) == Approx(3));
    for (const auto& p : plan.points) {
      CHECK(p.speed_mps == Approx(speed_mps));
      CHECK(p.accel_mps2 == 0);
      CHECK(p.s_m == Approx(270 + speed_mps * p.t_s));
      CHECK(distance_m(p.at, way->path().at(p.s_m).at) < 1e-9);
    }
  }
}

TEST_CASE("a plan to keep the speed may lead beyond the end of a route") {
  const auto way = test::straight(100, {{0, 13.9}});
  const auto plan = keep_speed(*way, now, 90, 10);
  CHECK(plan.is_sound());
  CHECK(plan.points.back().s_m == Approx(120));
}
