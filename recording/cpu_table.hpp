// Computing time of a run on the wall clock: what was measured, and the shares
// of a core that it means.
#pragma once

#include "actors/runtime/cpu_ledger.hpp"
#include "base/time.hpp"
#include "recording/cpu_balance.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::recording {

/// What was measured.
struct cpu_table {
  std::vector<actors::cpu_line> lines;
  duration length{};      ///< Of the measurement.
  duration process_cpu{}; ///< Of all threads in it, actors or not.
  /// What one look at the thread's clock takes. Measuring a turn takes two of
  /// them, and one is in the turn's account.
  duration look{};

  /// @returns how many turns all actors had.
  std::uint64_t wakes() const;
};

/// Measures from its making on.
class cpu_meter {
public:
  /// @param ledger  Of the run; outlives this. It begins anew.
  /// @param now     In the run.
  cpu_meter(actors::cpu_ledger& ledger, time_point now);

  cpu_table read(time_point now) const;

private:
  actors::cpu_ledger* ledger_;
  duration look_{};
  time_point began_;
  duration process_began_{};
};

/// @returns a share of one core, percent; nullopt for no time.
std::optional<double> percent_of_core(duration cpu, duration time);

/// One service in the vehicles of a run, all vehicles together.
struct cpu_figures {
  /// Shares of one vehicle. Its function is the local instance, environment
  /// model included. Its requester is SOFOF in the vehicle: the requester, its
  /// managers, which also decode what providers send and encode what they get,
  /// and the watchdogs; of all services.
  cpu_shares shares;
  double requester_mean = 0; ///< c_SR over all the time, percent of a core.
  std::size_t vehicles = 0;
  double active_s = 0;   ///< t_a, all vehicles together.
  double inactive_s = 0; ///< t_d, likewise.
  /// What of `requester_mean` is the measuring itself, percent of a core.
  double overhead = 0;
};

/// @returns the figures of a service; nullopt unless it was both local and
/// remote in some vehicle.
std::optional<cpu_figures> figures_of(const cpu_table& table,
                                      std::string_view service);

/// @param runs  At least one, with the same number of vehicles each.
/// @returns all of them as one long run: each share by its own time.
cpu_figures together(std::span<const cpu_figures> runs);

/// @returns the table as cpu.csv; docs/results.md says what it holds.
std::string to_csv(const cpu_table& table);

} // namespace sofof::recording
