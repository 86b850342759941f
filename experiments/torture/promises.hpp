// Holds a run's results to what SOFOF promises.
#pragma once

#include "experiments/report/run_files.hpp"
#include "experiments/torture/tally.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::torture {

/// A promise that a run has broken.
struct broken_promise {
  std::string promise; ///< Its name, one word.
  std::string what;    ///< Where and how, a sentence without a line end.

  friend bool operator==(const broken_promise&,
                         const broken_promise&) = default;
};

/// A run's results, read once for all checks.
struct finished_run {
  scenario::scenario_definition what;
  std::filesystem::path folder;
  report::run_summary summary;
  std::vector<report::episode_line> episodes;
  std::vector<report::cycle_line> cycles;
  std::vector<report::octets_line> octets;
  std::vector<report::load_line> load;
  recording::load_table disturbed;
  std::vector<report::event_line> events;
  bool has_liars = false;  ///< Providers that say what they did not plan.
  bool has_ghosts = false; ///< Cars that are not there, who are braked for.

  /// @returns a figure of the summary, 0 for one that it does not have.
  double figure(const std::string& name) const;
};

/// @returns when a vehicle's computer dies, if it does, since the start.
std::optional<double> dies_at_s(const scenario::scenario_definition& s,
                                std::uint64_t station);
/// @returns whether any does.
bool any_dies(const scenario::scenario_definition& s);

/// @throws input_error when a file is missing or broken.
finished_run read_finished(const scenario::scenario_definition& what,
                           const std::filesystem::path& folder);

using broken_promises = std::vector<broken_promise>;

/// Each adds what it finds, the first few of a kind.
/// @{
/// Never without a fresh plan, never off the road, no collision.
void check_safety(const finished_run& run, broken_promises& to);
/// Nobody is taken for a liar who is none, but for what it cannot see.
void check_belief(const finished_run& run, broken_promises& to);
/// Used results are of the source in use, in order, within their limits, and
/// without gaps.
void check_sources(const finished_run& run, broken_promises& to);
/// No service of a chain is without results for longer than limits admit.
void check_chain(const finished_run& run, broken_promises& to);
/// Both sides close each session, once, soon after each other.
void check_ledger(const finished_run& run, broken_promises& to);
/// Figures of the summary are those of the files.
void check_sums(const finished_run& run, broken_promises& to);
/// Each step of the protocol keeps its rules (docs/trace.md).
void check_conformance(const finished_run& run, broken_promises& to);
/// No octet appears or vanishes.
void check_octets(const finished_run& run, broken_promises& to);
/// @}

/// @returns all that is broken.
broken_promises check(const finished_run& run);

/// @returns what is counted of a run.
tally count(const finished_run& run);

} // namespace sofof::experiments::torture
