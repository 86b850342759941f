// When a vehicle's own function runs along.
#include "offloading/warm_standby.hpp"

#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace std::chrono_literals;
using offloading::warm_standby;
using test::at;

namespace {

const messages::qos_limits warm_limits{40ms, 100ms, 400ms};

/// One whose time after a change is over.
warm_standby long_offloaded() {
  warm_standby x{2s, warm_limits};
  x.begin(at(0s));
  x.on_used(at(9'990ms), at(9'900ms), at(10s));
  return x;
}

} // namespace

TEST_CASE("without a time the own function never runs along") {
  warm_standby x{0s, warm_limits};
  CHECK_FALSE(x.is_on());
  x.begin(at(0s));
  x.foresee(at(1s));
  x.on_used(at(1s), at(0s), at(2s));
  for (const auto t : {0s, 1s, 2s})
    CHECK_FALSE(x.runs_along(at(t)));
}

TEST_CASE("the own function runs along for its time after a provider has "
          "taken over, and no longer") {
  warm_standby x{2s, warm_limits};
  CHECK_FALSE(x.runs_along(at(0s)));
  x.begin(at(1s));
  CHECK(x.runs_along(at(1s)));
  CHECK(x.runs_along(at(3s - 1ns)));
  CHECK_FALSE(x.runs_along(at(3s)));
}

TEST_CASE("it runs along again from a sign on that the service may come "
          "home") {
  auto x = long_offloaded();
  REQUIRE_FALSE(x.runs_along(at(10s)));
  SUBCASE("who decides foresees it") {
    x.foresee(at(10s));
  }
  SUBCASE("a result took more than three quarters of its latency") {
    x.on_used(at(10s - 30ms), at(9'900ms), at(10s));
    CHECK_FALSE(x.runs_along(at(10s)));
    x.on_used(at(10s - 30ms - 1ns), at(9'900ms), at(10s));
  }
  SUBCASE("an input is older than three quarters of its age") {
    x.on_used(at(9'990ms), at(10s - 300ms), at(10s));
    CHECK_FALSE(x.runs_along(at(10s)));
    x.on_used(at(9'990ms), at(10s - 300ms - 1ns), at(10s));
  }
  CHECK(x.runs_along(at(10s)));
  CHECK(x.runs_along(at(12s - 1ns)));
  CHECK_FALSE(x.runs_along(at(12s)));
}

TEST_CASE("a result is missed after three quarters of the longest gap, and "
          "every result begins that anew") {
  auto x = long_offloaded();
  CHECK(x.missed_at() == at(10'075ms));
  x.on_used(at(10'040ms), at(10s), at(10'050ms));
  CHECK(x.missed_at() == at(10'125ms));
}

TEST_CASE("a later sign never shortens the time, and none outlives the "
          "end") {
  warm_standby x{2s, warm_limits};
  x.begin(at(1s));
  x.foresee(at(2s));
  CHECK(x.runs_along(at(4s - 1ns)));
  x.end();
  CHECK_FALSE(x.runs_along(at(2s)));
}
