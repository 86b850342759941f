// How late a vehicle may respond by the limits of its scenario.
#pragma once

#include "base/time.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace sofof::experiments::report {

/// What the limits of each service of a chain admit, by who computes it, in
/// every vehicle of a scenario: docs/chain.md, "The time of a split".
class admitted_times {
public:
  explicit admitted_times(const scenario::scenario_definition& s);

  /// @param station  Of a vehicle of the scenario.
  /// @param away     By service, in the order of the chain: whether a provider
  ///                 computes it.
  /// @returns the longest time from a look of the vehicle's sensors to a plan
  /// that depends on it; nullopt if nothing limits it, or there is no such
  /// vehicle.
  std::optional<duration> of(std::uint64_t station,
                             const std::vector<bool>& away) const;

private:
  struct times {
    duration own{}, away{}; ///< duration::max(): no limit.
  };
  struct fleet {
    std::uint64_t first = 0, count = 0; ///< Stations.
    std::vector<times> services;        ///< In the order of the chain.
  };
  std::vector<fleet> fleets_;
};

} // namespace sofof::experiments::report
