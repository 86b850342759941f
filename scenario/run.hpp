// Runs a scenario from its first moment to its last, and keeps the results.
#pragma once

#include "base/input_error.hpp"
#include "network/network_address.hpp"
#include "recording/exposition.hpp"
#include "recording/progress.hpp"
#include "recording/write_failure.hpp"
#include "scenario/scenario.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sofof::scenario {

class live_view; // scenario/live_view.hpp, as
struct live_subject;
class runtime;        // scenario/runtime.hpp
struct process_share; // scenario/build.hpp, as
struct world_actors;

/// Datagrams of ITS messages.
struct udp_options {
  network::network_address to;                  ///< Gets what is sent here.
  std::optional<network::network_address> from; ///< Where others send to.
};

/// Shows a run while it goes on. @throws network::network_error when it cannot.
using live_view_maker =
    std::function<std::unique_ptr<live_view>(const live_subject&)>;

struct run_options {
  std::optional<std::filesystem::path> out; ///< Results folder, if asked for.
  /// Which of several processes writes it: part of the name if none is asked
  /// for.
  std::string whose;
  std::vector<std::string> changes; ///< By `--set`: likewise.
  std::string pcap;   ///< Where to capture all ITS messages, if asked for.
  bool force = false; ///< Write into a folder that is not empty.
  recording::write_failure when_unwritable =
      recording::write_failure::ends_the_run;
  bool realtime = false; ///< On the wall clock instead of in virtual time.
  /// In virtual time: this many compute; results are the same.
  std::size_t threads = 1;
  /// Keep accounts of computing time, for cpu.csv; on the wall clock only.
  bool cpu = false;
  bool time_decisions = true; ///< For timing.csv, by the wall's clock.
  recording::progress::output show = recording::progress::output::quiet;
  bool colour = false;  ///< The console is a terminal.
  bool endless = false; ///< Until it is interrupted, which is a good end.
  std::string version;
  std::string network; ///< What messages cross, if not the modelled channel.
  /// Where to serve figures while it goes on; on the wall clock only.
  std::optional<network::network_address> metrics;
  std::string role = "run"; ///< What this process is in them.
  live_view_maker live;     ///< If anybody looks on; on the wall clock only.
  /// Where ITS messages go to and come from as datagrams, if asked for; on the
  /// wall clock only.
  std::optional<udp_options> udp;
  /// Adds to them what no record tells, on any thread.
  std::function<void(recording::exposition&)> more_figures;
  /// Called when the run is about to end, before its actors are.
  std::function<void()> when_ending;
  /// Called ten times a second of a run on the wall clock.
  /// @returns lines to show. What it throws ends the run.
  std::function<std::vector<std::string>()> news;
};

/// How a run ended; the values are the command's exit codes.
enum class run_outcome {
  good = 0,
  failed = 1, ///< It was unsafe, an actor died, or its results were lost.
  interrupted = 130, ///< As a shell counts Ctrl-C.
};

/// Others would not have this run, which has hardly begun.
class start_refused : public input_error {
public:
  using input_error::input_error;
};

/// @returns what config.toml of the results folder says: the effective
/// configuration, which runs again wherever the folder goes.
std::string configuration_of(scenario_definition s);

/// @param s            Loaded.
/// @param interrupted  Once true, the run ends soon; what was recorded is
///                     kept and marked.
/// @param console      Gets the progress and the final table.
/// @throws input_error when the results folder is refused, or it or the
///         capture cannot be written and this ends the run, or computing time
///         is asked for where none passes.
run_outcome run(const scenario_definition& s, const run_options& options,
                const std::atomic<bool>& interrupted, std::ostream& console);

/// The same for a part of a scenario, in a runtime of the caller's.
/// @param on_start  Called once the actors live, before time passes.
///                  What it throws leaves no results; nor does a start_refused
///                  that comes with the news.
run_outcome
run_part(const scenario_definition& s, const run_options& options,
         const process_share& here, runtime& time,
         const std::atomic<bool>& interrupted, std::ostream& console,
         const std::function<void(const world_actors&)>& on_start = {});

} // namespace sofof::scenario
