// When a service at 20 Hz makes its results.
#pragma once

#include "base/time.hpp"

namespace sofof::test {

inline time_point cycle(std::uint64_t n) {
  return time_point{n * std::chrono::milliseconds{50}};
}

} // namespace sofof::test
