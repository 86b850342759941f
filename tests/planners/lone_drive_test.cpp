// How long a way takes a car that is alone on it.
#include "planners/speed/lone_drive.hpp"

#include "tests/planners/usual_drive.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <memory>

using namespace sofof;
using namespace sofof::planners;
using test::near;
using test::style;
using test::town;

namespace {

double alone_s(const world::route_ptr& way, double from_m, double speed_mps,
               double to_m) {
  return lone_drive_s(route_profile{way, style}, style, from_m, speed_mps,
                      to_m);
}

} // namespace

TEST_CASE("at its limit a car takes way over speed") {
  const auto way = test::straight(2000, {{0, 10}});
  CHECK(alone_s(way, 100, 10, 1100) == near(100, 1e-6));
  CHECK(alone_s(way, 100, 10, 100) == 0);
}

TEST_CASE("a car that sets off takes as long as its acceleration does") {
  const auto way = test::straight(2000, {{0, 12}});
  // 12 m/s at 1.5 m/s² with a jerk of 1.5 m/s³ at rest: 8.5 s for 48 m.
  CHECK(alone_s(way, 0, 0, 1000)
        == near(8.5 + (1000 - 12 * 12 / 3.) / 12, 0.2));
}

TEST_CASE("a part of a way and its rest take as long as the whole") {
  const auto way = test::oval(town);
  const auto whole_s = alone_s(way, 20, 5, 520);
  CHECK(alone_s(way, 20, 5, 320) < whole_s);
  CHECK(alone_s(way, 20, 5, 321) > alone_s(way, 20, 5, 320));
}

TEST_CASE("each further lap takes as long") {
  const auto way = test::oval(town);
  const auto lap_m = way->length_m();
  const auto until_s = [&](double laps) {
    return alone_s(way, 20, 0, 20 + laps * lap_m);
  };
  CHECK(until_s(1) > until_s(2) - until_s(1)); // it sets off in the first
  CHECK(until_s(3) - until_s(2) == near(until_s(2) - until_s(1), 1e-3));
}

TEST_CASE("the planner takes a car along a free road as quickly as that") {
  for (const auto& way : {test::straight(600, town), test::s_curve(town)}) {
    auto drive = test::optimal(way, 0, 0);
    while (drive.car.speed_mps > 0 || drive.s_m() < way->length_m() / 2)
      drive.cycle();
    const auto driven_s = to_seconds(drive.now - time_point{});
    CHECK(drive.front_m() == near(way->length_m(), 1.0));
    CHECK(alone_s(way, 0, 0, drive.s_m()) == near(driven_s, 1.5));
  }
  const auto way = test::oval(town);
  auto drive = test::optimal(way, 0, 0);
  drive.drive(120);
  CHECK(alone_s(way, 0, 0, drive.s_m()) == near(120, 2.5));
}
