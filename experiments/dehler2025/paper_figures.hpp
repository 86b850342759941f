// What the runs of a reproduction say of each figure and table of the paper.
#pragma once

#include "experiments/dehler2025/interval.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "recording/cpu_balance.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sofof::experiments::study {

/// A point of the latency plot.
struct curve_point {
  double limit_ms = 0;             ///< Δt_max.
  std::optional<interval> t_off_s; ///< Nothing without an offloading.
};

/// What a number of vehicles gives.
struct vehicle_figures {
  int vehicles = 1;
  std::vector<curve_point> curve; ///< Limits ascending.
  std::optional<double> time_in_area_s;
  std::optional<interval> latency_ms; ///< Of the mean.
  double latency_deviation_ms = 0;
  double late_share = 0; ///< Of latencies, above l_max.
};

struct paper_figures {
  std::vector<vehicle_figures> by_vehicles; ///< Vehicles ascending.
  spread real_latency_ms;
  std::uint64_t drives = 0;
  std::uint64_t drives_ended_early = 0;
  recording::cpu_shares cpu_20_hz;
  recording::cpu_shares cpu_100_hz;
  std::optional<double> v2x_at_most; ///< Percent of a core, at 20 Hz.
  double switches = 0;
  double largest_speed_jump_mps = 0; ///< Where the source of the plan changes.
  double largest_acceleration_jump_mps2 = 0;
};

/// @throws input_error when a run's files are broken or lack a figure.
paper_figures figures_of(const paper_runs& e);

/// @returns the milliseconds of a duration as sweeps have it, "80ms".
double ms_of(const std::string& duration_text);

/// The longest limit of the plot, where curves have their height.
inline constexpr auto longest_limit = "150ms";

} // namespace sofof::experiments::study
