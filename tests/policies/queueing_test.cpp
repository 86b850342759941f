// Tests of how busy a provider may be.
#include "policies/algorithms/assignment/queueing.hpp"

#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

namespace sofof::policies::assignment {

using namespace std::chrono_literals;
using test::dice;
using test::near;

TEST_CASE("at the cap jobs wait exactly as long as allowed") {
  dice random{1};
  for (int k = 0; k < 100; ++k) {
    const auto service = from_seconds(random.between(0.001, 0.1));
    const auto allowed = from_seconds(random.between(0.001, 0.1));
    const auto wait = mean_wait(service, utilisation_cap(1, service, allowed));
    REQUIRE(wait);
    CHECK(to_seconds(*wait) == near(to_seconds(allowed), 1e-5));
  }
}

TEST_CASE("six cores may be busy six times as much as one") {
  CHECK(utilisation_cap(6, 8ms, 16ms)
        == near(6 * utilisation_cap(1, 8ms, 16ms), 1e-12));
}

TEST_CASE("who may not wait at all may not use anything") {
  CHECK(utilisation_cap(6, 8ms, 0ms) == 0);
}

TEST_CASE("a queue at full utilisation grows without end") {
  CHECK(mean_wait(8ms, 0) == 0ms);
  CHECK_FALSE(mean_wait(8ms, 1));
  CHECK_FALSE(mean_wait(8ms, 1.5));
}

} // namespace sofof::policies::assignment
