// Who plays the offloading game: a task, two ways to compute it, and what
// each of them costs.
// Source: Chen, Jiao, Li & Fu, Efficient multi-user computation offloading
// for mobile-edge cloud computing, ToN 24(5), 2016 ("Chen 2016").
#pragma once

namespace sofof::policies::game {

/// A user with one task. Everything is finite and ≥ 0; see each field for
/// what must be more.
struct player {
  double cycles = 0;             ///< d, of the task; > 0.
  double bits = 0;               ///< b, sent when offloading; > 0.
  double local_clock_hz = 0;     ///< f^m; > 0.
  double cloud_clock_hz = 0;     ///< f^c, granted by the provider; > 0.
  double energy_per_cycle_j = 0; ///< γ, of the local processor.
  double transmit_power_w = 0;   ///< q; > 0 where time has no weight.
  double tail_energy_j = 0;      ///< L, for holding the channel afterwards.
  double time_weight = 0;        ///< λ^t, 1/s, in [0, 1].
  double energy_weight = 0;      ///< λ^e, 1/J, in [0, 1]; not both 0.

  double received_power_w = 0;  ///< q·g at the station; for interference, > 0.
  double lone_rate_bps = 0;     ///< R, alone on a channel; for contention, > 0.
  double contention_weight = 1; ///< W, share of a channel; > 0.
};

/// What computing the task locally costs.
/// Source: Chen 2016, eq. (4).
double local_cost(const player& p);

/// What offloading the task costs.
/// @param rate_bps  Of the uplink, ≥ 0.
/// @returns infinity when the rate is 0.
/// Source: Chen 2016, eq. (8).
double offloading_cost(const player& p, double rate_bps);

/// The least rate at which offloading costs no more than computing locally.
/// @returns bit/s; infinity when no rate is enough.
/// Source: Chen 2016, proof of Lemma 1.
double beneficial_rate_bps(const player& p);

} // namespace sofof::policies::game
