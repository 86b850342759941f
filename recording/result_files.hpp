// The files in the results folder of a run: every record becomes a line while
// it runs, the summary comes last. What they hold: docs/results.md.
#pragma once

#include "base/files/output_file.hpp"
#include "base/text/csv.hpp"
#include "messages/protocol/record.hpp"
#include "recording/columns.hpp"
#include "recording/metrics.hpp"
#include "recording/pcap_file.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::recording {

/// Figures of the wall's clock, which no seed repeats.
struct figures_of_clock {
  struct timing {
    std::string name; ///< With its unit, e.g. "solve_p99_us".
    double value;
  };
  std::vector<timing> timings; ///< For timing.csv.
  std::string cpu_csv;         ///< cpu.csv; empty: none.
};

/// Every member throws `input_error` when the disk refuses to take more.
class result_files {
public:
  /// Removes the files of an earlier run and starts new ones.
  /// @param folder  Exists.
  result_files(std::filesystem::path folder, const run_info& run);

  void on_record(const messages::record& x);

  void write(std::span<const disturbed_messages> all);

  /// Brings all files up to date.
  void flush();

  /// Writes quality.csv.
  void write_quality(std::string_view csv) const;

  /// Closes all files and writes those of the end, once.
  void finish(const metrics& all, const run_info& run, const run_end& end,
              const figures_of_clock& clock);

private:
  using timing = figures_of_clock::timing;

  void write(const messages::event_record& x);
  void write(const messages::cycle_record& x);
  void write(const messages::episode_record& x);
  void write(const messages::track_record& x);
  void write(const messages::claim_record& x);
  void write(const messages::scene_record& x);
  void write(const messages::response_record& x);
  void write(const messages::air_record& x);
  void write(const messages::trace_record& x);
  template <class Other>
  void write(const Other&) {}

  std::string_view name_of(provider_id provider) const;
  row_context context_of(const messages::session_id& session) const;
  void write_vehicles(const metrics& all) const;
  void write_distributions(const metrics& all) const;
  void write_timing(const run_end& end,
                    const std::vector<timing>& timings) const;

  std::optional<pcap_file> pcap_; // before results are replaced
  std::filesystem::path folder_;
  time_point start_;
  provider_names names_;
  csv_file<episode_row> episodes_;
  std::optional<csv_file<cycle_row>> cycles_;
  std::optional<csv_file<track_row>> tracks_;
  std::optional<csv_file<margin_row>> margins_;
  std::optional<csv_file<plan_row>> plans_;
  std::map<station_id, std::int64_t> planned_;      // in which period, last
  std::optional<csv_file<claim_row>> claims_;       // once there is one
  std::optional<csv_file<scene_row>> scenes_;       // likewise
  std::optional<csv_file<response_row>> responses_; // likewise
  std::optional<csv_file<trace_row>> trace_;
  csv_file<disturbed_row> disturbed_;
  output_file events_;
};

} // namespace sofof::recording
