// Rates on a shared channel, and their inverses.
#include "policies/algorithms/game/channel_model.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::policies::game {

double interference::rate_bps(const player& p, double received) const {
  assert(received >= 0);
  const auto ratio = p.received_power_w / (noise_w_ + received);
  return bandwidth_hz_ * std::log1p(ratio) / std::numbers::ln2;
}

double interference::received_at(const player& p, double rate_bps) const {
  assert(rate_bps > 0);
  const auto ratio = std::expm1(rate_bps / bandwidth_hz_ * std::numbers::ln2);
  return p.received_power_w / ratio - noise_w_;
}

double contention::rate_bps(const player& p, double received) const {
  const auto share = p.contention_weight / (p.contention_weight + received);
  return p.lone_rate_bps * share;
}

double contention::received_at(const player& p, double rate_bps) const {
  assert(rate_bps > 0);
  return p.contention_weight * (p.lone_rate_bps / rate_bps - 1);
}

} // namespace sofof::policies::game
