// Whether offloading pays in computing time, and what that is in energy.
#include "recording/cpu_balance.hpp"

#include <cassert>

namespace sofof::recording {

namespace {

constexpr double percent = 0.01;
constexpr double m_per_km = 1000;

} // namespace

double share_without_offloading(const cpu_shares& c) {
  return c.active;
}

double share_with_offloading(const cpu_shares& c, double offloaded) {
  assert(offloaded >= 0 && offloaded <= 1);
  return (1 - offloaded) * (c.active + c.requester)
         + offloaded * (c.inactive + c.requester_remote);
}

double saved_while_offloaded(const cpu_shares& c) {
  return (c.active - c.inactive) - (c.requester_remote - c.requester);
}

std::optional<double> break_even_share(const cpu_shares& c) {
  const auto saved = saved_while_offloaded(c);
  if (saved <= 0)
    return std::nullopt;
  return c.requester / saved;
}

double energy_j_per_km(double share, double speed_mps,
                       const core_power& power) {
  return share * percent * power.more_when_busy_w() * m_per_km / speed_mps;
}

} // namespace sofof::recording
