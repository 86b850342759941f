// Waits of an M/D/1 queue.
#include "policies/algorithms/assignment/queueing.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

namespace sofof::policies::assignment {

using namespace std::chrono_literals;
using test::near;

// Source: a prototype of ours, to the digits that it printed.
TEST_CASE("jobs of 8 ms wait as long as a prototype says") {
  const auto wait_ms = [](double utilisation) {
    return to_milliseconds(mean_wait(8ms, utilisation).value());
  };
  CHECK(wait_ms(0.3) == near(1.71, 0.003));
  CHECK(wait_ms(0.5) == near(4.00, 1e-6));
  CHECK(wait_ms(0.7) == near(9.33, 0.001));
  CHECK(wait_ms(0.8) == near(16.0, 1e-6));
  CHECK(wait_ms(0.9) == near(36.0, 1e-6));
}

// Source: the formula at S = 8 ms, w* = 16 ms.
TEST_CASE("a core with jobs of 8 ms that may wait 16 ms is busy for 80 %") {
  CHECK(utilisation_cap(1, 8ms, 16ms) == near(0.8, 1e-12));
}

} // namespace sofof::policies::assignment
