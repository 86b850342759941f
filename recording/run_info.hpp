// What is known of a run before it starts, and once it has ended.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/etsi/its_time.hpp"
#include "world/vehicle/energy_use.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::recording {

/// What a service takes out of one vehicle's battery, J.
struct service_cost {
  double on_board_j = 0; ///< For each cycle on board,
  double input_j = 0;    ///< for each input that it sends,
  double result_j = 0;   ///< and for each result of a provider.
  duration run_time{};   ///< Of a cycle there, on average,
  duration period{};     ///< which is one in each.
};

/// By vehicle and service.
using service_costs =
    std::map<std::pair<station_id, std::string>, service_cost>;

/// What energy is reckoned from.
struct energy_terms {
  service_costs costs; ///< Of the vehicles that are driven here.
  std::map<station_id, world::vehicle_power> vehicles; ///< The same ones.
  std::map<std::string, world::server_power> servers;  ///< By provider.
  /// Services by name, those that work on each other's results together, the
  /// first one first; others alone.
  std::vector<std::vector<std::string>> chains;
};

/// Providers by id; one that has started again has the name of its place.
using provider_names = std::map<provider_id, std::string>;

/// @returns a provider's name; empty for one of no configuration.
inline std::string_view name_of(provider_id provider,
                                const provider_names& names) {
  auto found = names.find(provider);
  if (found == names.end()) // of a process of its own
    found = names.find(place_of(provider));
  return found != names.end() ? std::string_view{found->second} : "";
}

/// A file that a policy needs, as it was.
struct policy_copy {
  std::string text;
  bool is_executable = false;
};

/// Known before the first record.
struct run_info {
  std::string scenario;    ///< Its name.
  std::string version;     ///< Of this program.
  std::string clock;       ///< Whose time passed: "virtual" or "wall".
  std::string profile;     ///< Of the channel.
  std::string lodm;        ///< Title of the policy.
  std::string codm;        ///< Likewise.
  std::string config_toml; ///< The effective configuration.
  std::string map_toml;    ///< The map that it names; empty for none.
  /// Maps of providers that it names, by their names in the folder.
  std::map<std::string, std::string> provider_maps;
  std::string trace_text; ///< The trace that it names; empty for none.
  /// What was learned before, that it names; empty for none.
  std::string forecast_csv;
  /// Files that policies need, by their names in the results folder.
  std::map<std::string, policy_copy> policy_files;
  std::int64_t seed = 0;
  std::size_t vehicles = 0;
  std::string provider; ///< The one that is all that runs here; often empty.
  std::uint32_t obstacles = 0; ///< They have the highest station ids.
  recording::provider_names provider_names;
  std::vector<std::string> services; ///< Names, in the order of reports.
  /// Those of them that a plan comes from, in their order: a chain, or planning
  /// alone; none without it.
  std::vector<std::string> chain;
  /// The kind whose figures stand at the top level of the summary.
  std::string headline_kind = "trajectory_planning";
  energy_terms energy;
  bool cycles = true;   ///< Write cycles.csv and responses.csv.
  bool tracks = true;   ///< Write tracks.csv.
  bool margins = false; ///< Write margins.csv.
  bool plans = false;   ///< Write plans.csv.
  bool trace = false;   ///< Write protocol_trace.csv.
  std::string pcap;     ///< Where to capture all ITS messages; empty: nowhere.
  messages::etsi::its_clock time_of_day;
  time_point start; ///< Second 0 of all files.
};

/// How long a run on the wall clock did not get a core though it wanted one.
struct standstill {
  static constexpr duration least = std::chrono::milliseconds{20};

  duration together{}; ///< Of times of more than `least` each.
  duration longest{};
  duration longest_at{}; ///< Since the watch began, when that was over.

  /// Who was to be woken was woken so much later.
  /// @param at  Since the watch began.
  void woken_late(duration by, duration at) {
    if (by <= least)
      return;
    together += by;
    if (by > longest) {
      longest = by;
      longest_at = at;
    }
  }
};

/// Known once the run has ended.
struct run_end {
  double virtual_s = 0; ///< From the start on, on the run's clock.
  double wall_s = 0;    ///< The same on the wall's.
  bool interrupted = false;
  standstill stood_still{};

  /// @returns how much faster than real time it was; nullopt for no time.
  std::optional<double> x_real_time() const {
    return wall_s > 0 ? std::optional{virtual_s / wall_s} : std::nullopt;
  }
};

} // namespace sofof::recording
