// What one cycle of a function costs a vehicle: on board, and offloaded.
#pragma once

#include "base/core_order.hpp"
#include "base/options/option_visitor.hpp"
#include "base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace sofof::world {

/// A vehicle's computer and radio.
struct computer_options {
  double clock_ghz = 3;           ///< f.
  double capacitance_js2 = 1e-28; ///< κ, what its gates switch: as usual in
                                  ///< studies of offloading, not measured.
  double transmit_power_w = 0.2;  ///< p, 23 dBm.
  double uplink_mbps = 20;        ///< r, that it gets of the air.
  /// What a busy core takes beyond one that is not, W; without: κ f³.
  std::optional<double> computing_w{};
  /// What a function that rests takes of what it would if it ran: 28.3 of
  /// 116.1 % of a core. Source: Dehler & Buchholz 2025, table I, real vehicle.
  double resting_share = 0.244;
  /// What an octet that is received takes of one that is sent: 51.97 of 438.39
  /// mW per Mbit/s. Source: Huang et al., MobiSys 2012, of an LTE telephone.
  double receiving_share = 0.12;

  /// How the vehicle's own functions share its cores in virtual time; by
  /// default each has one of its own.
  std::optional<core_order> scheduling;
  std::int64_t cores = 1; ///< That they share.
  /// Whether a vehicle is refused that cannot take all its functions back.
  bool strict = false;

  void visit_options(option_visitor& s);
};

/// What clocks are compared with: the run times of services are those at this
/// one.
inline constexpr double usual_clock_ghz = computer_options{}.clock_ghz;

/// The cycle whose computing times a `provider_compute` draws takes so long on
/// board, at `usual_clock_ghz`: that of trajectory planning.
inline constexpr duration usual_run_time = std::chrono::microseconds{5500};

/// What one cycle of a function asks of who computes it, and of the radio: the
/// one source of its computing times here and there, and of its energy.
struct cycle_options {
  duration run_time_mean{}; ///< On board, at `usual_clock_ghz`: c / f.
  duration run_time_sd{};
  duration run_time_max{};
  /// At a provider: computing time as a multiple of what its
  /// `provider_compute` draws, where that was measured; else it is in
  /// proportion to the run time: `demand_of`.
  std::optional<double> demand;
  std::int64_t input_octets = 0; ///< On the air, of one input, b / 8.
  double overhead_j = 0;         ///< Of the framework itself, for each result.

  void visit_options(option_visitor& s);
};

/// @returns a provider's computing time of a cycle, in that of a cycle which
/// takes `usual_run_time` on board.
double demand_of(const cycle_options& cycle);

/// @returns what no drawn run time of a cycle on board exceeds.
duration longest_run_time(const cycle_options& cycle);

/// Time from the begin of a cycle on, and energy out of the vehicle's battery.
struct cycle_cost {
  double time_s = 0;
  double energy_j = 0;
};

/// @returns what a busy core takes beyond one that is not, W: κ f³, unless the
/// options say it.
double computing_power_w(const computer_options& computer);

/// Of a cycle on board: T = c / f and E = κ f² c, of c cycles of the clock, or
/// T times the power that the options say. Source: Mao, Zhang & Letaief, JSAC
/// 34(12) 2016; κ is that of public code for it (LODCO.m in
/// hliangzhao/Edge-Computing-Codes).
cycle_cost on_board_cost(const computer_options& computer,
                         const cycle_options& cycle);

/// Of sending one input: T = b / r, and E = p b / r; without the network's
/// delay and without waits. Source: as before.
cycle_cost sending_cost(const computer_options& computer,
                        const cycle_options& cycle);

} // namespace sofof::world
