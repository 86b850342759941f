// The energy of both ends: what each service of each vehicle took in each split
// of its chain, in the vehicle, on the air and at providers, beside what the
// vehicle would have taken for computing all of it itself.
#pragma once

#include "recording/load_table.hpp"
#include "recording/run_info.hpp"
#include "recording/split_ledger.hpp"
#include "world/vehicle/energy_use.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::recording {

/// Energy in whole nanojoules, so that sums of parts are exact.
struct exact_energy {
  std::int64_t computing_nj = 0, resting_nj = 0, framework_nj = 0;
  std::int64_t sending_nj = 0, receiving_nj = 0;
  std::int64_t server_busy_nj = 0, server_idle_nj = 0;

  /// @returns each part rounded.
  static exact_energy of(const world::energy_parts& x);

  std::int64_t vehicle_nj() const {
    return computing_nj + resting_nj + framework_nj;
  }
  std::int64_t radio_nj() const { return sending_nj + receiving_nj; }
  std::int64_t server_nj() const { return server_busy_nj + server_idle_nj; }
  std::int64_t nj() const { return vehicle_nj() + radio_nj() + server_nj(); }

  exact_energy& operator+=(const exact_energy& x);
};

/// @returns J.
constexpr double joules(std::int64_t nj) {
  return 1e-9 * static_cast<double>(nj);
}

/// What some of it adds up to.
struct energy_balance {
  duration driven{};
  double distance_m = 0;
  exact_energy spent{};
  std::int64_t home_nj = 0; ///< Predicted, for computing it all in the vehicle.
  double home_s = 0;        ///< Likewise, of a core.
  double own_s = 0; ///< Of a core of the vehicle, with functions that rest.
  bool is_known = false; ///< Of any vehicle whose power is known.

  std::int64_t saved_nj() const { return home_nj - spent.nj(); }
  std::optional<double> saved_j_per_km() const;
  /// @returns the power of the vehicles' computers at which nothing is saved
  /// or lost, W; see `world::break_even_w`. nullopt where none does.
  std::optional<double> break_even_w() const;

  energy_balance& operator+=(const energy_balance& x);
};

/// One service of one vehicle in one split of its chain; or, of no vehicle,
/// what a provider computed for results that no vehicle got.
struct energy_row {
  std::optional<station_id> station{};
  std::size_t chain = 0;
  split where{}; ///< Empty of no vehicle.
  std::string service{};
  std::string place{}; ///< Empty: in the vehicle.
  service_use use{};
  double resting_s = 0;
  duration driven{};
  double distance_m = 0;
  exact_energy spent{};
  std::int64_t home_nj = 0;
  double home_s = 0, resting_share = 0;

  duration served() const;
  /// @returns what it adds to a sum. Time and distance, which the services of
  /// a chain share, are left out.
  energy_balance balance() const;
};

/// How a chain is called: by its last service.
using split_key = std::pair<std::size_t, split>;

/// All of a terms.
struct energy_table {
  std::vector<energy_row> rows; ///< By vehicle, chain, split and service.
  std::map<split_key, energy_balance> splits; ///< All vehicles together.
  energy_balance all;                         ///< Sum of all rows.
  std::size_t vehicles = 0;                   ///< That have rows.
  /// Of being there, of providers that had work, for the time in which they
  /// had none: of no service, and in no sum. J.
  double unused_server_j = 0;
};

/// Prices what was done. While a chain is in the vehicle, what it would have
/// taken there is what it took. In any other split it is, of each of its
/// services, a result in each period, each of the mean computing time that
/// results of vehicles' own functions had in this run, in proportion to the
/// computer's; where there were none, of that of the configuration.
/// @param length  Of the terms.
energy_table energy_of(const split_ledger& done, const energy_terms& terms,
                       const load_table& load, duration length);

/// @returns "vehicle>mec>mec".
std::string name_of(const split& where);

/// @returns energy.csv; docs/results.md says what it holds.
std::string to_csv(const energy_table& table, const energy_terms& terms);

} // namespace sofof::recording
