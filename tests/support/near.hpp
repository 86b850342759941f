// Comparison by relative error alone; doctest's Approx adds 1 to the values
// before it takes its epsilon of them, so that everything far below 1 passes.
#pragma once

#include <doctest/doctest.h>

namespace sofof::test {

/// @param fraction  Of the expected value, > 0.
inline doctest::Approx near(double expected, double fraction) {
  return doctest::Approx(expected).epsilon(fraction).scale(0);
}

} // namespace sofof::test
