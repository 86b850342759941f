// How long a vehicle stays away from a provider whose result was refused.
#include "offloading/distrust.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace sofof::offloading {

duration distrust::add(time_point now) {
  constexpr duration first = std::chrono::seconds{60};
  constexpr std::uint32_t most_doublings = 16; // 45 days
  const auto pause =
      first * (std::int64_t{1} << std::min(refused_, most_doublings));
  ++refused_;
  until_ = std::max(until_, now + pause);
  assert(holds(now));
  return pause;
}

} // namespace sofof::offloading
