// All that a results folder holds of one episode.
#pragma once

#include "experiments/report/run_files.hpp"
#include "recording/load_table.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sofof::experiments::explain {

/// Which episode.
struct question {
  std::optional<std::uint64_t> station{}; ///< Any, if not said.
  std::optional<double> at_s{}; ///< The one that runs then, or is nearest.
  std::string service{};        ///< Any, if empty.

  /// @returns whether a vehicle or a service is the one that is asked about.
  bool is_about(const report::session_key& x) const {
    return (!station || x.station == *station)
           && (service.empty() || x.service == service);
  }
};

/// The share of what servers can do that was asked for, by their name
/// ("workers", "uplink", "downlink").
using asked_shares = std::map<std::string, double>;

/// Those that a question is about.
struct candidates {
  std::size_t all = 0;
  std::size_t early = 0; ///< Of them ended for other than a planned reason.
  std::set<std::string> services{};
};

/// All that is known of one episode.
struct episode {
  report::episode_line closed; ///< By the vehicle.
  candidates among;            ///< It is one of these.
  std::optional<report::episode_line> at_provider;
  std::optional<report::episode_line> next; ///< Of this service and vehicle.
  std::vector<report::event_line> events;   ///< Of this vehicle and provider.
  /// With their parts; nothing when the run wrote none.
  std::optional<std::vector<report::cycle_line>> results;
  /// Share of the octets that the provider sent for the service, to whom ever;
  /// nothing when no modelled cell counted them.
  std::optional<double> lost;
  /// What became of the result that was due after the last one that came;
  /// nothing where that is not recorded.
  std::optional<channel::disturbance> disturbed;
  bool cut_off = false; ///< By the end of the run.
  asked_shares load;    ///< Of the provider, at most in the last second or two.
};

/// @returns whether an episode ended for other than a planned reason.
bool ended_early(const report::episode_line& x);

/// @returns how far an episode is from a moment, s; 0 when it runs then.
double distance_s(const report::episode_line& x, double at_s);

/// @returns the episode that is asked about: without a time the first that
/// ended early, or else the longest; nothing where no vehicle closed any.
/// @throws input_error with file and line when the folder is broken, or of a
/// version that did not record where the time went.
std::optional<episode> find_episode(const std::filesystem::path& folder,
                                    const question& question);

} // namespace sofof::experiments::explain
