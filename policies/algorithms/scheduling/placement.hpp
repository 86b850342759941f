// Which core takes a further session.
#pragma once

#include "policies/api/periodic_task.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::policies {

/// What a core must pass to take a session.
enum class admission_test {
  utilisation, ///< `fits_by_utilisation`: breaks deadlines shorter than
               ///< periods.
  demand,      ///< `fits_by_demand`: keeps them without any phases.
  phases,      ///< `assigned_offset`: keeps them while sessions keep phase.
};

struct core_place {
  std::size_t core = 0;
  duration offset{0}; ///< To be assigned to the session; 0 without phases.

  friend bool operator==(const core_place&, const core_place&) = default;
};

/// Worst fit: of the cores that pass the test with the session, the one with
/// the least utilisation, which leaves the most even reserves; the first of
/// equals.
/// @param cores  Sessions that run on each.
/// @returns nullopt if no core passes: reject.
std::optional<core_place>
worst_fit(std::span<const std::vector<periodic_task>> cores,
          const periodic_task& session, admission_test test);

} // namespace sofof::policies
