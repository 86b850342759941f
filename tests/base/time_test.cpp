// Tests of times, which are nanoseconds since the run's clock began.
#include "base/time.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;

namespace {

void check_as_llround(double seconds) {
  CAPTURE(seconds);
  CHECK(from_seconds(seconds).count() == std::llround(seconds * 1e9));
  CHECK(from_seconds(-seconds).count() == std::llround(-seconds * 1e9));
}

} // namespace

TEST_CASE("seconds become the nearest whole number of nanoseconds, halves the "
          "one away from zero") {
  CHECK(from_seconds(0.5e-9).count() == 1);
  CHECK(from_seconds(-0.5e-9).count() == -1);
  CHECK(from_seconds(0.49e-9).count() == 0);
  CHECK(from_seconds(1.5).count() == 1'500'000'000);
  test::dice random{5};
  for (int k = 0; k < 100'000; ++k) {
    const auto magnitude = std::exp2(random.between(-35, 33));
    check_as_llround(magnitude);
    // A half nanosecond beside it, as nearly as doubles allow.
    const auto half = (std::floor(magnitude * 1e9) + 0.5) * 1e-9;
    check_as_llround(half);
    check_as_llround(std::nextafter(half, 0));
    check_as_llround(std::nextafter(half, 1e10));
  }
}
