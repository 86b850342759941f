// The results of a run: its figures, and its files as long as they can be
// written.
#pragma once

#include "messages/protocol/record.hpp"
#include "recording/cpu_table.hpp"
#include "recording/metrics.hpp"
#include "recording/response_ledger.hpp"
#include "recording/result_files.hpp"
#include "recording/run_info.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace sofof::recording {

/// Counts every record of a run, and writes it to the files in its folder.
/// Every member throws `input_error` when the disk refuses to take more; what
/// was not written has not been counted either, so that it may be taken again
/// once the files are closed.
class results final : public messages::record_sink {
public:
  /// Removes the files of an earlier run and starts new ones.
  /// @param folder  From `make_results_folder`, or any that exists.
  results(std::filesystem::path folder, run_info run);
  /// Without files.
  explicit results(run_info run);

  void on_record(const messages::record& x) override;

  /// A figure of the wall's clock, for timing.csv.
  /// @param name  With its unit, e.g. "solve_p99_us".
  void add_timing(std::string name, double value);

  /// Who computed how much, for cpu.csv.
  void add_cpu(const cpu_table& x);

  /// Messages that were disturbed, for disturbed.csv and for what made gaps
  /// between results.
  /// @param all    In order of time.
  /// @param until  All that were sent before then have been told of now.
  void add_disturbed(std::span<const disturbed_messages> all, time_point until);

  /// What providers and cells had to do, for load.csv and octets.csv.
  void add_load(load_table x) { metrics_.add(std::move(x)); }

  /// What vehicles have learned of places, for quality.csv; empty: nothing.
  void add_quality(std::string csv) { quality_csv_ = std::move(csv); }

  const metrics& so_far() const { return metrics_; }

  /// Brings all files up to date; to be called now and then, so that a killed
  /// run keeps what it recorded.
  void flush();

  /// Writes no more files; what they hold stays, as of a run that was killed.
  void close_files() { files_.reset(); }

  /// Closes all files and writes the summary, once. A folder without one is
  /// of a run that was killed.
  /// @returns what has become of the run, for the final table.
  run_end finish(time_point end, double wall_s, bool interrupted,
                 standstill stood_still = {});

private:
  void keep(const messages::record& x);
  template <class Record>
  void follow(const Record&) {}
  void follow(const messages::stage_record& x);

  run_info run_;
  metrics metrics_;
  response_ledger ledger_;
  figures_of_clock of_clock_;
  std::string quality_csv_;
  std::optional<result_files> files_;
};

} // namespace sofof::recording
