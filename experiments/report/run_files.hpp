// The lines of a results folder's files, as docs/results.md describes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

/// Which offloading, in all files.
struct session_key {
  std::string provider;
  std::string service;
  std::uint64_t provider_id = 0;
  std::uint64_t station = 0;
  std::uint64_t counter = 0;

  friend auto operator<=>(const session_key&, const session_key&) = default;
};

/// Of episodes.csv.
struct episode_line {
  session_key of;
  bool by_requester = false; ///< Else the provider has closed it.
  double accepted_s = 0;
  std::optional<double> first_data_s;
  double ended_s = 0;
  std::optional<double> t_off_s;
  std::string reason;
  bool fallback = false;
  /// Columns that the report does not read itself, by their names.
  std::vector<std::pair<std::string, std::string>> others{};
};

/// Of cycles.csv.
struct cycle_line {
  session_key of;
  double received_s = 0;
  double latency_ms = 0;
  std::optional<double> interarrival_ms;
  std::optional<double> input_age_ms; ///< Not in folders of older versions.
};

/// Of tracks.csv.
struct track_line {
  std::uint64_t station = 0;
  double t_s = 0;
  double x_m = 0, y_m = 0; ///< Of the rear axle.
  double heading_rad = 0;
  double speed_mps = 0;
  bool remote = false;
};

/// Of events.jsonl.
struct event_line {
  double t_s = 0;
  std::string what;
  session_key of;
  std::string detail;
};

/// Of summary.json.
struct run_summary {
  /// All numbers, by dotted names ("latency_ms.mean"), without what is null.
  std::map<std::string, double> figures;
  std::string version; ///< Of the program that ran it.
  std::string clock;   ///< "virtual" or "wall".
  bool interrupted = false;
  /// The run in sentences; none of older versions.
  std::vector<std::string> headline;
};

/// @returns nothing when the run was killed before it wrote any.
/// @throws input_error when it is broken.
std::optional<run_summary> read_summary(const std::filesystem::path& folder);

/// Each reads one file of a results folder.
/// @throws input_error with file and line when it cannot be read or a line is
/// not as docs/results.md says.
std::vector<episode_line> read_episodes(const std::filesystem::path& folder);
std::vector<event_line> read_events(const std::filesystem::path& folder);

/// @returns nothing when the run was told not to write this file.
std::optional<std::vector<cycle_line>>
read_cycles(const std::filesystem::path& folder);
std::optional<std::vector<track_line>>
read_tracks(const std::filesystem::path& folder);

} // namespace sofof::experiments::report
