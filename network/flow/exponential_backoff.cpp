// When to try again what has failed.
#include "network/flow/exponential_backoff.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::network {

duration exponential_backoff::next_wait(double draw) {
  assert(draw >= 0 && draw < 1);
  const auto wait = from_seconds(to_seconds(period_) * (1 - draw / 2));
  period_ = std::clamp(2 * period_, first_, longest_);
  return wait;
}

} // namespace sofof::network
