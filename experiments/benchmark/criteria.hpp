// By what policies are compared: figures of a run, and a score made of them.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::bench {

enum class better { more, less, neither };

class summary_figures;
struct baseline;

/// One column of a leaderboard, all that is to be said of it. Meanings:
/// docs/bench.md.
struct criterion {
  std::string_view name;  ///< In files, with its unit.
  std::string_view title; ///< For people, with its unit.
  std::string_view brief; ///< The same in a narrow table; empty: not in it.
  int decimals = 0;
  better wanted = better::neither;
  /// Of a run; nothing where it does not tell. Null for a comparison.
  std::optional<double> (*of)(const summary_figures& run,
                              const baseline& by) = nullptr;
  /// Of a comparison: the entrant that the score is compared with.
  std::string_view with{};
};

/// @returns all of them, in the order of columns; none is of the wall's clock.
std::span<const criterion> criteria();

inline constexpr std::string_view score_name = "score";
inline constexpr std::string_view regret_name = "regret_percent";
inline constexpr std::string_view than_location_name = "than_location_percent";

/// A provider's computer.
struct provider_capacity {
  double workers = 1;
  /// The share of them that a running service takes.
  std::map<std::string, double, std::less<>> utilisation_by;
};

/// What a scenario asks of a service.
struct service_baseline {
  std::string name;
  double limit_s = 0;  ///< τ: longest latency.
  double period_s = 0; ///< T_p: of its cycles.
  double local_s = 0;  ///< T_loc: of a cycle on board, mean.
};

/// What a scenario says about its runs, whoever decides.
struct baseline {
  std::vector<service_baseline> services;
  std::vector<provider_capacity> providers; ///< By their places.
};

/// @param s  Loaded.
baseline baseline_of(const scenario::scenario_definition& s);

/// A run of an entrant, judged.
struct judged_run {
  std::string entrant;
  std::string scenario;
  std::int64_t seed = 0;
  bool safe = true; ///< Its safety line held.
  /// By names of criteria; what a run does not tell is missing.
  std::map<std::string_view, double> values;
};

/// @param run  Of a scenario that `by` is of.
/// @throws input_error when its summary lacks what every run writes.
judged_run judge(const study::measured_run& run, const baseline& by);

/// Adds to each run how much worse its score is than those of the entrants
/// called "oracle" and "location", in the same scenario with the same seed,
/// percent of theirs: so noise that they have in common does not count.
void compare_scores(std::vector<judged_run>& runs);

} // namespace sofof::experiments::bench
