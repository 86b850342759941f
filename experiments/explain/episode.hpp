// What a results folder holds of one episode.
#pragma once

#include "experiments/report/run_files.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sofof::experiments::explain {

/// One side's line of episodes.csv.
struct closed_episode {
  report::session_key of;
  bool by_requester = false;
  double accepted_s = 0;
  std::optional<double> first_data_s; ///< None: no data in time.
  double ended_s = 0;
  std::string reason;
  bool fallback = false;
  std::string because;
};

/// Where the time from an input to its result went, ms.
struct time_parts {
  double uplink_wait = 0, uplink = 0;
  double rest = 0; ///< The input waited for its cycle.
  double queue = 0, computing = 0;
  double downlink_wait = 0, downlink = 0;
};

/// A line of cycles.csv.
struct received_result {
  std::uint64_t cycle = 0;
  double received_s = 0;
  double latency_ms = 0;
  double input_age_ms = 0;
  bool used = false;
  time_parts ms;
};

/// The share of what servers can do that was asked for, by their name
/// ("workers", "uplink", "downlink").
using asked_shares = std::map<std::string, double>;

/// @returns all lines, in their order.
/// @throws input_error with file and line, as all below.
std::vector<closed_episode> read_episodes(const std::filesystem::path& folder);

/// @returns the results of a session; nothing when the run wrote none.
std::optional<std::vector<received_result>>
read_results(const std::filesystem::path& folder,
             const report::session_key& session);

/// @returns whether results between others of this vehicle, provider and
/// service did not come: no result tells of their cycles.
bool has_gaps(const std::filesystem::path& folder,
              const report::session_key& session);

/// @returns the share of the octets that a provider sent for a service that was
/// lost; nothing when no modelled cell counted it.
std::optional<double> lost_share(const std::filesystem::path& folder,
                                 const std::string& provider,
                                 const std::string& service);

/// @returns those of a provider in a second or in the one before, whichever is
/// larger; empty when the run wrote none.
asked_shares read_load(const std::filesystem::path& folder,
                       const std::string& provider, double at_s);

} // namespace sofof::experiments::explain
