// The results folder of a run: every record becomes a line while it runs,
// the summary comes last. What the files hold: docs/results.md.
#pragma once

#include "messages/record.hpp"
#include "scenario/cpu_table.hpp"
#include "scenario/csv.hpp"
#include "scenario/metrics.hpp"
#include "scenario/output_file.hpp"
#include "scenario/pcap_file.hpp"
#include "scenario/run_info.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Writes the files of one run. Every member throws `input_error` when the
/// disk refuses to take more.
class results final : public record_sink {
public:
  /// Removes the files of an earlier run and starts new ones.
  /// @param folder  From `make_results_folder`, or any that exists.
  results(std::filesystem::path folder, run_info run);

  void take(const event_record& x) override;
  void take(const decision_record& x) override;
  void take(const cycle_record& x) override;
  void take(const episode_record& x) override;
  void take(const track_record& x) override;
  void take(const safety_record& x) override;
  void take(const collision_record& x) override;
  void take(const drive_record& x) override;
  void take(const plan_switch_record& x) override;
  void take(const air_record& x) override;

  /// A figure of the wall's clock, for timing.csv.
  /// @param name  With its unit, e.g. "solve_p99_us".
  void take_timing(std::string name, double value);

  /// Who computed how much, for cpu.csv.
  void take(const cpu_table& x);

  const metrics& so_far() const { return metrics_; }

  /// Brings all files up to date; to be called every few seconds, so that a
  /// killed run keeps what it recorded.
  void flush();

  /// Closes all files and writes the summary, once. A folder without one is
  /// of a run that was killed.
  /// @returns what has become of the run, for the final table.
  run_end finish(time_point end, double wall_s, bool interrupted);

private:
  struct timing {
    std::string name;
    double value;
  };

  std::string_view name_of(boot_id provider) const;
  void write_vehicles() const;
  void write_distributions() const;
  void write_timing(const run_end& end) const;

  std::optional<pcap_file> pcap_; // before results are replaced
  std::filesystem::path folder_;
  run_info run_;
  metrics metrics_;
  std::map<boot_id, std::string> names_;
  std::vector<timing> timings_;
  std::string cpu_csv_; // empty: none
  csv_file episodes_;
  std::optional<csv_file> cycles_;
  std::optional<csv_file> tracks_;
  output_file events_;
};

} // namespace sofof
