// When to try again what has failed.
#include "network/flow/exponential_backoff.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::network {

namespace {

using namespace std::chrono_literals;

constexpr duration first_period = 100ms;
constexpr duration longest_period = 1s;

} // namespace

duration exponential_backoff::next_wait(double draw) {
  assert(draw >= 0 && draw < 1);
  const auto wait = from_seconds(to_seconds(period_) * (1 - draw / 2));
  period_ = std::clamp(2 * period_, first_period, longest_period);
  return wait;
}

} // namespace sofof::network
