// What the runs of a reproduction say of each figure and table of the paper.
#pragma once

#include "experiments/dehler2025/interval.hpp"
#include "experiments/dehler2025/sections.hpp"

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
  std::optional<interval> latency_ms; ///< Of the mean; as `latency_runs`.
  double latency_deviation_ms = 0;    ///< Likewise.
  /// How much mean and deviation changed from the number of vehicles before, in
  /// the mean over seeds.
  std::optional<interval> mean_step_ms{};
  std::optional<interval> deviation_step_ms{};
  double late_share = 0; ///< Likewise; of those above l_max.
};

/// What one vehicle's computer does, percent of one core; the vehicles of a run
/// are the groups of its intervals, which so tell nothing of another machine.
struct cost_figures {
  interval active;           ///< See `recording::cpu_shares`.
  interval inactive;         ///< Likewise.
  interval requester_remote; ///< Likewise.
  /// Percent of the time from which on offloading pays, see
  /// `recording::break_even_share`; infinite ends where a vehicle never would,
  /// nothing where all together never would.
  std::optional<interval> break_even{};
};

struct paper_figures {
  std::vector<vehicle_figures> by_vehicles; ///< Vehicles ascending.
  spread real_latency_ms;
  std::uint64_t drives = 0;
  std::uint64_t drives_ended_early = 0;
  std::optional<cost_figures> cpu_20_hz;
  std::optional<cost_figures> cpu_100_hz;
  std::optional<double> v2x_at_most; ///< Percent of a core, at any rate.
  double switches = 0;
  double largest_speed_jump_mps = 0; ///< Where the source of the plan changes.
  double largest_acceleration_jump_mps2 = 0;
};

/// The runs of so many vehicles that the paper's delay plot is held against: of
/// all limits, and of the seeds that every point of the latency plot has.
/// Points with more seeds than others would otherwise weigh more, and not alike
/// for each number of vehicles.
std::vector<const measured_run*> latency_runs(const paper_runs& e,
                                              const std::string& vehicles);

/// @throws input_error when a run's files are broken or lack a figure.
paper_figures figures_of(const paper_runs& e);

/// @returns the milliseconds of a duration as sweeps have it, "80ms".
double ms_of(const std::string& duration_text);

/// The longest limit of the plot, where curves have their height.
inline constexpr auto longest_limit = "150ms";

} // namespace sofof::experiments::study
