// Tests of how long a vehicle stays away from a provider that has lied.
#include "offloading/distrust.hpp"

#include <doctest/doctest.h>

using namespace sofof;

namespace {

using namespace std::chrono_literals;

} // namespace

TEST_CASE("who has never lied is believed") {
  CHECK(!offloading::distrust{}.holds(time_point{}));
}

TEST_CASE("after a lie nothing is asked for 60 s, then for twice as long each "
          "time") {
  offloading::distrust x;
  time_point now{100s};
  for (const duration pause : {60s, 120s, 240s, 480s}) {
    CHECK(x.add(now) == pause);
    CHECK(x.holds(now + pause - 1ns));
    now += pause;
    CHECK(!x.holds(now));
  }
}

TEST_CASE("a liar is asked at most four times in ten minutes") {
  offloading::distrust x;
  int asked = 0;
  for (time_point now{}; now < time_point{600s}; now += 1s)
    if (!x.holds(now)) {
      ++asked;
      x.add(now);
    }
  CHECK(asked == 4);
}

TEST_CASE("any number of lies is counted") {
  offloading::distrust x;
  for (int n = 0; n < 1000; ++n)
    x.add(time_point{});
  CHECK(x.holds(time_point{24h * 40}));
}
