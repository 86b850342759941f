// How often a car stands.
#include "world/vehicle/trip.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

using namespace sofof::world;
using sofof::test::near;

namespace {

struct ride {
  stop_meter meter;

  void go(double speed_mps, int steps) {
    for (auto k = 0; k < steps; ++k)
      meter.add(speed_mps, 0.01);
  }
};

} // namespace

TEST_CASE("who has not set off yet does not stop") {
  ride r;
  r.go(0, 1000);
  r.go(5, 100);
  CHECK(r.meter.count() == 0);
  CHECK(r.meter.longest_s() == 0);
}

TEST_CASE("a stop counts once, as long as it lasts") {
  ride r;
  r.go(5, 100);
  r.go(0, 250);
  CHECK(r.meter.count() == 1);
  CHECK(r.meter.longest_s() == near(2.5, 1e-9));
}

TEST_CASE("who creeps up in a queue stops once, and stands all that time") {
  ride r;
  r.go(5, 100);
  for (auto k = 0; k < 3; ++k) {
    r.go(0, 200);
    r.go(0.4, 50);
  }
  CHECK(r.meter.count() == 1);
  CHECK(r.meter.longest_s() == near(6, 1e-9));
}

TEST_CASE("of several stops the longest is told") {
  ride r;
  for (const auto steps : {100, 700, 300}) {
    r.go(5, 100);
    r.go(0.05, steps);
  }
  CHECK(r.meter.count() == 3);
  CHECK(r.meter.longest_s() == near(7, 1e-9));
}
