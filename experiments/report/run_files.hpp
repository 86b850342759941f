// The lines of a results folder's files, as docs/results.md describes them.
#pragma once

#include "base/files/line_file.hpp"
#include "base/text/csv_reader.hpp"
#include "recording/load_table.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
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
  std::string because; ///< Empty in folders of older versions, too.
  /// @returns whether the end of the vehicle's drive ended it.
  bool is_cut_off() const;

  /// Columns that the report does not read itself, by their names.
  std::vector<std::pair<std::string, std::string>> others{};
};

/// Where the time from an input to its result went, ms.
struct time_parts {
  double uplink_wait = 0, uplink = 0;
  double rest = 0; ///< The input waited for its cycle.
  double queue = 0, computing = 0;
  double downlink_wait = 0, downlink = 0;
};

/// Of cycles.csv.
struct cycle_line {
  session_key of;
  std::uint64_t cycle = 0;
  double received_s = 0;
  double latency_ms = 0;
  bool used = false;
  std::optional<double> interarrival_ms;
  std::optional<double> input_age_ms; ///< Not in folders of older versions.
  std::optional<time_parts> parts;    ///< Likewise.
};

/// Of load.csv.
struct load_line {
  double t_s = 0; ///< Its second begins.
  std::string provider;
  std::string what; ///< "workers", "uplink", "downlink".
  double asked_share = 0;
  // Of jobs that arrived in it; none without any, and in older folders.
  std::optional<double> mean_wait_ms, max_wait_ms;
};

/// Of octets.csv.
struct octets_line {
  /// Its second begins; folders of older versions have one line for all.
  std::optional<double> t_s;
  std::string provider;
  std::string direction; ///< "up" or "down".
  std::string what;      ///< What they were for: a service, say.
  std::uint64_t messages = 0;
  std::uint64_t sent = 0, delivered = 0, lost = 0, under_way = 0;
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

/// Of claims.csv.
struct claim_line {
  std::uint64_t station = 0;
  std::string lane; ///< By which it came.
  double claimed_s = 0;
  std::optional<double> bound_s; ///< None: it was given up before.
  double enters_s = 0, leaves_s = 0;
  bool was_kept = false;
};

/// Of responses.csv.
struct response_line {
  std::uint64_t station = 0;
  double t_s = 0; ///< It was sensed.
  double response_ms = 0;
};

/// Of scene.csv.
struct scene_line {
  std::uint64_t station = 0;
  double t_s = 0;
  std::string service; ///< That has looked.
  double safe_ms = 0;
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

/// Reads events one after the other.
class event_file {
public:
  explicit event_file(const std::filesystem::path& folder);

  /// @returns the next one; nullopt after the last.
  /// @throws input_error, as above.
  std::optional<event_line> next();

private:
  std::string name_;
  line_file lines_;
  bool was_killed_;
};

/// @returns nothing when the run was told not to write this file.
/// @param wanted  Which offloadings' lines; all, if empty.
std::optional<std::vector<cycle_line>>
read_cycles(const std::filesystem::path& folder,
            const std::function<bool(const session_key&)>& wanted = {});
/// Reads results one after the other; none where the run was told not to write
/// them.
class cycle_file {
public:
  explicit cycle_file(const std::filesystem::path& folder);

  /// @returns the next one; nullopt after the last.
  /// @throws input_error, as above.
  std::optional<cycle_line> next();

  /// @returns whether there is a file at all.
  bool is_there() const { return rows_.has_value(); }

private:
  std::optional<csv_reader> rows_;
  bool has_parts_ = false;
};

std::optional<std::vector<track_line>>
read_tracks(const std::filesystem::path& folder);

/// @returns no lines when the run wrote no such file.
std::vector<load_line> read_load(const std::filesystem::path& folder);
std::vector<octets_line> read_octets(const std::filesystem::path& folder);
std::vector<claim_line> read_claims(const std::filesystem::path& folder);
std::vector<response_line> read_responses(const std::filesystem::path& folder);
std::vector<scene_line> read_scene(const std::filesystem::path& folder);

/// @returns what disturbed.csv holds, without any other load; nothing when the
/// run wrote no such file.
std::optional<recording::load_table>
read_disturbed(const std::filesystem::path& folder);

} // namespace sofof::experiments::report
