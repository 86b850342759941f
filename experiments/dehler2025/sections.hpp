// The paper's evaluation, section by section, from finished runs.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"
#include "experiments/report/document.hpp"
#include "recording/cpu_table.hpp"

#include <optional>
#include <span>
#include <vector>

namespace sofof::experiments::study {

/// What runs on the wall's clock cost.
struct measured_cpu {
  recording::cpu_figures figures; ///< Of all vehicles and runs together.
  double speed_mps = 0;           ///< Mean of all vehicles.
  double length_s = 0;            ///< Of one run.
  /// Percent of a core, of one vehicle: its V2X messages and, since an actor
  /// has one account, what moves the simulated car and the links. So V2X takes
  /// less. Of the runs the largest.
  double v2x_at_most = 0;
  std::vector<recording::cpu_figures> runs{}; ///< Of all vehicles of each.
};

/// The runs of all sweeps in config/paper.
struct paper_runs {
  std::vector<measured_run> latency_plot; ///< Axes: vehicles, max_interarrival.
  std::vector<measured_run> delay_plot;   ///< Axis: vehicles.
  std::vector<measured_run> in_area;      ///< Axis: vehicles; with tracks.
  std::vector<measured_run> apart;        ///< Axis: start.
  std::vector<measured_run> stalls;       ///< Axes as of latency_plot.
  std::vector<measured_run> real_world;   ///< Axis: drive.
  std::vector<measured_run> quality;      ///< Axis: codm; with tracks.
  std::vector<measured_run> refusals;     ///< Axis: requirements.
  std::vector<measured_run> host;         ///< Axes: vehicles, host.
  std::vector<measured_run> correlated;   ///< Axes as of latency_plot.
  std::vector<measured_run> loaded_host;  ///< Likewise.
  measured_cpu cpu_20_hz;
  measured_cpu cpu_100_hz;
};

/// How long vehicles stay offloaded, against the longest gap that they accept.
report::section latency_plot(const paper_runs& e);

/// How long results are on their way, against the number of vehicles; their
/// distribution.
report::section delay_plot(const paper_runs& e);

/// The real drives as an emulation.
report::section real_world(const paper_runs& e);

/// Computing time in the vehicle, and whether offloading pays.
report::section cpu_cost(const paper_runs& e);

/// How often LODM and CODM refuse, and what that changes.
report::section refusals(const paper_runs& e);

/// What the headlines hang on: choices of ours, and what the model lacks.
report::section sensitivity(const paper_runs& e);

/// What offloading does to the driving.
report::section quality(const paper_runs& e);

} // namespace sofof::experiments::study
