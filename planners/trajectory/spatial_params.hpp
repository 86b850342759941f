// What can be set of the trajectory planner.
#pragma once

#include "base/options/option_visitor.hpp"

#include <cstdint>

namespace sofof::planners {

/// How far, how finely and how thoroughly a planner plans.
struct spatial_params {
  double horizon_m = 80;
  double step_m = 1;
  std::int64_t candidates = 2;   ///< Ways past the others that are weighed.
  std::int64_t alternations = 1; ///< Path, speed, path for these speeds, …
  /// Before crossings where others go first it reckons with seeing no
  /// farther than this; 0: it does not.
  double cautious_sight_m = 0;

  void visit_options(option_visitor& s);
};

} // namespace sofof::planners
