// What a study needs to know of one finished run.
#pragma once

#include "base/ids.hpp"
#include "experiments/sweep/plan.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::study {

/// The service that studies are about.
inline constexpr auto planning = "trajectory_planning";

struct measured_run {
  sweep_point point;
  std::filesystem::path folder;
  /// What summary.json says, by dotted names ("latency_ms.mean"), without what
  /// is null.
  std::map<std::string, double> figures;
  /// Of each episode of trajectory planning that did not just run when the run
  /// ended: from the first result in time to the end of the offloading. This is
  /// what t_off means wherever the study says it; a request that was accepted
  /// and never got a result is not among them.
  std::vector<double> t_off_s;
  std::uint64_t ended_early = 0; ///< Episodes that ended by a violation.
  /// How long providers, by their places, have run each service for vehicles.
  std::map<std::pair<provider_id, std::string>, double> served_s{};
  std::uint64_t ended_late = 0; ///< Of `ended_early`, those for a latency.

  /// @throws input_error for one that the summary does not have.
  double figure(const std::string& name) const;
};

/// @param folder  Of a run that came to its end.
/// @throws input_error when a file is missing or broken.
measured_run read_run(const sweep_point& point,
                      const std::filesystem::path& folder);

/// @returns each value that the axis of this number takes, as it comes first.
std::vector<std::string> labels_of(std::span<const measured_run> runs,
                                   std::size_t axis);

/// @returns those whose axis number `axis` has this value.
std::vector<const measured_run*> those(std::span<const measured_run> runs,
                                       std::size_t axis,
                                       const std::string& label);

/// The same for two axes, the first and the second.
std::vector<const measured_run*> those(std::span<const measured_run> runs,
                                       const std::string& first,
                                       const std::string& second);

/// Mean and standard deviation of all values together.
struct spread {
  double mean = 0;
  double deviation = 0;
  double count = 0;
};

/// @param name  Of a figure with `.count`, `.mean` and `.std`.
/// @returns those of all values of all these runs that have two or more.
spread pooled(std::span<const measured_run* const> runs,
              const std::string& name);

} // namespace sofof::experiments::study
