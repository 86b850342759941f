// When a run was safe: the one definition, for runs, the console, sweeps and
// the bench.
#pragma once

#include "recording/metrics.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace sofof::recording {

/// A figure that is 0 in a safe run.
struct safety_criterion {
  std::string_view name; ///< In the summary.
  double (*of)(const safety_metrics& x);
};

inline constexpr safety_criterion safety_line[]{
    {"safety.without_fresh_plan_s",
     [](const safety_metrics& x) { return to_seconds(x.without_fresh_plan); }},
    {"safety.off_road_s",
     [](const safety_metrics& x) { return to_seconds(x.off_road); }},
    {"safety.collisions",
     [](const safety_metrics& x) { return static_cast<double>(x.collisions); }},
};

/// @param figure  Gives a number of summary.json by its dotted name; it throws
///                where there is none.
/// @returns whether the run that the summary is of was safe.
template <class Figure>
bool is_safe(Figure figure) {
  return std::ranges::all_of(safety_line, [&figure](const auto& x) {
    return figure(std::string{x.name}) == 0;
  });
}

} // namespace sofof::recording
