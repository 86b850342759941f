// When in its period something periodic begins, if nobody says so.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"

#include <cassert>

namespace sofof {

/// @param noise   A stream of its own.
/// @param period  > 0.
/// @returns a time in [0, period).
inline duration random_phase(const random_stream& noise, duration period) {
  assert(period > duration{0});
  return duration{static_cast<duration::rep>(
      noise.uniform(0) * static_cast<double>(period.count()))};
}

} // namespace sofof
