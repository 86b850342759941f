// Cycles of services, by where they were computed, and what they took out of
// the vehicles' batteries.
#pragma once

#include "messages/protocol/record.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace sofof::recording {

/// How often a service was computed.
struct cycle_figures {
  std::uint64_t on_board = 0;  ///< In the vehicle, and the result was used.
  std::uint64_t offloaded = 0; ///< By a provider, and the result was used.
  std::uint64_t results = 0;   ///< From all providers, used or not.
  std::uint64_t inputs = 0;    ///< That vehicles sent to providers.
  std::uint64_t along = 0;     ///< In the vehicle, and the result was not used.

  /// @returns the share of cycles that were offloaded; nullopt for none.
  std::optional<double> offloaded_share() const;

  cycle_figures& operator+=(const cycle_figures& x);
};

/// What cycles took out of batteries, J.
struct energy_figures {
  double on_board_j = 0;     ///< By computing.
  double offloading_j = 0;   ///< By sending inputs, and by the framework.
  double all_on_board_j = 0; ///< If nothing had been offloaded.

  double j() const { return on_board_j + offloading_j; }
  /// @returns the share of energy that offloading saves; nullopt for none.
  std::optional<double> saved_share() const;

  energy_figures& operator+=(const energy_figures& x);
};

/// Adds up what vehicles tell of their services. Sums are by service, by
/// vehicle, or of all.
class cycle_ledger {
public:
  /// @param costs  What is not in it costs nothing.
  explicit cycle_ledger(service_costs costs) : costs_{std::move(costs)} {}

  void add(const messages::work_record& x);
  void add(const messages::cycle_record& x);

  cycle_figures cycles(const messages::service_name& service) const;
  cycle_figures cycles(const messages::service_name& service,
                       station_id station) const;

  energy_figures energy() const;
  energy_figures energy(const messages::service_name& service) const;
  energy_figures energy(station_id station) const;

private:
  using user = std::pair<station_id, messages::service_name>;
  struct counts {
    cycle_figures figures;
    std::uint64_t newest = 0; // cycle
  };

  energy_figures energy_of(const user& who, const cycle_figures& x) const;

  service_costs costs_;
  std::map<user, counts> counts_;
};

} // namespace sofof::recording
