// How players on one channel slow each other down: the two models of
// Chen 2016.
#pragma once

#include "policies/algorithms/game/player.hpp"

#include <cassert>

namespace sofof::policies::game {

/// A channel makes a player slower the more weight it receives from the
/// others on it. That both models do so is what makes a potential game.
class channel_model {
public:
  virtual ~channel_model() = default;

  /// What the others on its channel receive from a player: ω > 0.
  virtual double weight(const player& p) const = 0;

  /// Rate of a player that receives this much weight from others.
  /// @param received  Sum of the others' weights, ≥ 0.
  /// @returns bit/s; falls strictly as `received` grows.
  virtual double rate_bps(const player& p, double received) const = 0;

  /// The inverse of rate_bps.
  /// @param rate_bps  > 0; infinity is allowed.
  /// @returns the weight at which the player has this rate; negative when it
  /// would not even have it alone.
  virtual double received_at(const player& p, double rate_bps) const = 0;
};

/// All send at once, and one's signal is the other's noise (CDMA).
/// Weights are received powers, W.
/// Source: Chen 2016, eq. (1) and Lemma 1.
class interference final : public channel_model {
public:
  /// @param bandwidth_hz  w, of each channel, > 0.
  /// @param noise_w       ϖ₀, background noise on each channel, > 0.
  interference(double bandwidth_hz, double noise_w)
      : bandwidth_hz_{bandwidth_hz}, noise_w_{noise_w} {
    assert(bandwidth_hz > 0 && noise_w > 0);
  }

  double weight(const player& p) const override { return p.received_power_w; }
  double rate_bps(const player& p, double received) const override;
  double received_at(const player& p, double rate_bps) const override;

private:
  double bandwidth_hz_;
  double noise_w_;
};

/// They take turns, each with a share of the time (CSMA, round robin); a
/// processor that tasks share equally follows the same law.
/// Weights are contention weights, without unit.
/// Source: Chen 2016, eq. (30) and Lemma 2.
class contention final : public channel_model {
public:
  double weight(const player& p) const override { return p.contention_weight; }
  double rate_bps(const player& p, double received) const override;
  double received_at(const player& p, double rate_bps) const override;
};

} // namespace sofof::policies::game
