// What one cycle of a function costs a vehicle: on board, and offloaded.
#pragma once

#include "base/options/option_visitor.hpp"
#include "base/time.hpp"

namespace sofof::world {

/// A vehicle's computer and radio.
struct computer_options {
  double clock_ghz = 3;           ///< f.
  double capacitance_js2 = 1e-28; ///< κ, what its gates switch: as usual in
                                  ///< studies of offloading, not measured.
  double transmit_power_w = 0.2;  ///< p, 23 dBm.
  double uplink_mbps = 20;        ///< r, that it gets of the air.

  void visit_options(option_visitor& s) {
    s.field("clock_ghz", clock_ghz, {0.1, 100});
    s.field("capacitance_js2", capacitance_js2, {0, 1e-20});
    s.field("transmit_power_w", transmit_power_w, {0, 100});
    s.field("uplink_mbps", uplink_mbps, {0.001, 1e6});
  }
};

/// What one cycle of a function asks of who computes it.
struct cycle_options {
  duration run_time_mean{}; ///< On board, in virtual time, at
                            ///< `usual_clock_ghz`.
  duration run_time_sd{};
  duration run_time_max{};
  double demand = 1; ///< At a provider: computing time, as a multiple of what
                     ///< its `provider_compute` draws.
  double gigacycles = 0.03; ///< c: 10 ms at 3 GHz.
  double input_kbit = 160;  ///< b, what a provider has to be told.
  double overhead_j = 0;    ///< Of the framework itself, when offloaded.

  void visit_options(option_visitor& s) {
    s.field("run_time_mean", run_time_mean, duration{0});
    s.field("run_time_sd", run_time_sd, duration{0});
    s.field("run_time_max", run_time_max, duration{0});
    s.field("demand", demand, {0, 1e3});
    s.field("gigacycles", gigacycles, {0, 1e3});
    s.field("input_kbit", input_kbit, {0, 1e6});
    s.field("overhead_j", overhead_j, {0, 1e3});
  }
};

/// Time from the begin of a cycle on, and energy out of the vehicle's battery.
struct cycle_cost {
  double time_s = 0;
  double energy_j = 0;
};

/// What clocks are compared with: the run times of services are those at this
/// one.
inline constexpr double usual_clock_ghz = computer_options{}.clock_ghz;

/// A provider's, of each worker.
inline constexpr double usual_provider_ghz = 12;

/// T = c / f and E = κ f² c.
/// Source: Mao, Zhang & Letaief, JSAC 34(12) 2016; κ is that of public code
/// for it (LODCO.m in hliangzhao/Edge-Computing-Codes).
cycle_cost on_board_cost(const computer_options& computer,
                         const cycle_options& cycle);

/// T = b / r + c / f of the provider, and E = p b / r + overhead; without the
/// network's delay and without waits. Source: as before.
cycle_cost offloaded_cost(const computer_options& computer,
                          const cycle_options& cycle,
                          double provider_ghz = usual_provider_ghz);

} // namespace sofof::world
