// What the two ways to compute a task cost.
#include "policies/algorithms/game/player.hpp"

#include <cassert>
#include <limits>

namespace sofof::policies::game {

namespace {

// What a second of sending costs.
double sending_cost_per_s(const player& p) {
  return p.time_weight + p.energy_weight * p.transmit_power_w;
}

// What offloading costs besides sending.
double fixed_cost(const player& p) {
  return p.time_weight * p.cycles / p.cloud_clock_hz
         + p.energy_weight * p.tail_energy_j;
}

} // namespace

double local_cost(const player& p) {
  assert(p.cycles > 0 && p.local_clock_hz > 0);
  return p.time_weight * p.cycles / p.local_clock_hz
         + p.energy_weight * p.energy_per_cycle_j * p.cycles;
}

double offloading_cost(const player& p, double rate_bps) {
  assert(p.bits > 0 && p.cloud_clock_hz > 0 && rate_bps >= 0);
  return sending_cost_per_s(p) * p.bits / rate_bps + fixed_cost(p);
}

double beneficial_rate_bps(const player& p) {
  const auto left_for_sending = local_cost(p) - fixed_cost(p);
  if (left_for_sending <= 0)
    return std::numeric_limits<double>::infinity();
  return sending_cost_per_s(p) * p.bits / left_for_sending;
}

} // namespace sofof::policies::game
