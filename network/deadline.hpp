// The clock of deadlines in the network; nothing here ever is an input of a
// simulation.
#pragma once

#include <algorithm>
#include <chrono>

namespace sofof::network {

using deadline_clock = std::chrono::steady_clock;
using deadline = deadline_clock::time_point;

/// @returns whole milliseconds until then, for poll(): at least 0, never less
/// than what is left.
inline int milliseconds_until(deadline end, deadline now) {
  using std::chrono::milliseconds;
  constexpr milliseconds longest{60'000};
  const auto left = std::chrono::ceil<milliseconds>(end - now);
  return static_cast<int>(
      std::clamp(left, milliseconds::zero(), longest).count());
}

} // namespace sofof::network
