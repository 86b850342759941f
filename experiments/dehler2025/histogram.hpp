// How durations of many runs are distributed.
#pragma once

#include "experiments/report/document.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace sofof::experiments::study {

/// Counts of durations by their upper bounds, ms, as distributions.csv has
/// them.
class histogram {
public:
  void add(double up_to_ms, std::uint64_t count) { bins_[up_to_ms] += count; }
  void add(const histogram& other);

  std::uint64_t count() const;

  /// @returns the share of durations up to each bound.
  report::curve cumulative(std::string name) const;

  /// @returns the share of durations above a bound, 0 … 1; 0 for none at all.
  double share_above(double ms) const;

private:
  std::map<double, std::uint64_t> bins_;
};

/// Reads one figure ("latency", "interarrival") of a service from a results
/// folder.
/// @throws input_error when distributions.csv is missing or broken.
histogram read_histogram(const std::filesystem::path& folder,
                         std::string_view service, std::string_view figure);

} // namespace sofof::experiments::study
