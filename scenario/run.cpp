// Runs a scenario from its first moment to its last, and keeps the results.
#include "scenario/run.hpp"

#include "actors/runtime/cpu_accounts.hpp"
#include "base/input_error.hpp"
#include "base/stopwatch.hpp"
#include "recording/console_summary.hpp"
#include "recording/cpu_table.hpp"
#include "recording/load_table.hpp"
#include "recording/locked_results.hpp"
#include "recording/pcap_file.hpp"
#include "recording/results_folder.hpp"
#include "scenario/build.hpp"
#include "scenario/datagram_air.hpp"
#include "scenario/decision_timer.hpp"
#include "scenario/energy_terms.hpp"
#include "scenario/live_view.hpp"
#include "scenario/operations.hpp"
#include "scenario/placement.hpp"
#include "scenario/policy_files.hpp"
#include "scenario/running_programs.hpp"
#include "scenario/runtime.hpp"
#include "scenario/stall_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <system_error>
#include <utility>

namespace sofof::scenario {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// The run is looked at so often: progress, Ctrl-C, flushing.
constexpr duration virtual_slice = 1s;
constexpr duration wall_slice = 100ms;
constexpr double flush_every_s = 2;
constexpr double flush_every_real_s = 0.5;

/// Accounts of computing time begin so late: roads are got ready once.
constexpr duration settling = 1s;

/// @returns the name of the copy of a provider's own map in a results folder.
std::string map_copy_of(std::size_t place) {
  return fmt::format("{}{}.toml", recording::provider_map_prefix, place + 1);
}

recording::run_info describe(const scenario_definition& s,
                             const run_options& options,
                             const process_share& here) {
  recording::run_info info;
  info.scenario = s.name;
  info.version = options.version;
  info.clock = options.realtime ? "wall" : "virtual";
  info.profile = options.network.empty() ? s.profiles() : options.network;
  info.lodm = s.policies.lodm->title();
  info.codm = s.policies.codm->title();
  info.config_toml = configuration_of(s);
  info.map_toml = s.map_text;
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    if (const auto& p = s.providers[k]; !p.map_text.empty())
      info.provider_maps[map_copy_of(k)] = p.map_text;
  info.trace_text = s.trace_text;
  info.forecast_csv = s.policies.forecast.text;
  for (const auto& file : s.policies.files)
    if (!file.copy.empty())
      info.policy_files[file.copy] = {file.text, file.is_executable};
  info.seed = s.seed;
  if (const auto* planning = planning_service(s))
    info.headline_kind = planning->name();
  for (const auto& v : place_vehicles(s))
    if (here.drives(v.station))
      ++info.vehicles;
  info.energy = energy_terms_of(s, here);
  if (info.vehicles == 0)
    for (std::size_t k = 0; k < s.providers.size(); ++k)
      if (here.provides(k))
        info.provider = s.providers[k].name;
  info.obstacles = static_cast<std::uint32_t>(s.obstacles.size());
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    info.provider_names.emplace(k + 1, s.providers[k].name);
  for (const auto& type : s.services)
    info.services.emplace_back(type->name());
  info.chain = chain_of(s);
  info.pcap = options.pcap;
  info.cycles = s.record.cycles;
  info.tracks = s.record.tracks;
  info.margins = s.record.margins;
  info.plans = s.record.plans;
  info.trace = s.record.trace;
  return info;
}

void tell_news(const run_options& options, recording::progress& shown,
               std::ostream& console) {
  for (const auto& line : options.news()) {
    shown.clear();
    console << line << std::endl;
  }
}

/// Tells once that files are no longer written.
class loss_teller {
public:
  void look_at(const recording::locked_results& keeper,
               recording::progress& shown, std::ostream& console) {
    if (is_told_)
      return;
    const auto why = keeper.loss();
    if (!why)
      return;
    is_told_ = true;
    shown.clear();
    console << "the run goes on without results: " << *why << std::endl;
  }

private:
  bool is_told_ = false;
};

/// How a run is played: what it is looked at with while it goes on.
struct stage {
  const run_options& options;
  const std::atomic<bool>& interrupted;
  std::ostream& console;
  recording::locked_results& keeper;
  loss_teller losses{};
  recording::progress shown{console, options.show};
  stopwatch watch{};
  std::optional<stall_watch> stalls{}; ///< On the wall clock.
  operations* watched = nullptr;       ///< Unless it is asked for,
  live_view* live = nullptr;           ///< as these.
  datagram_air* udp = nullptr;
};

/// Keeps which messages were disturbed before some time: the ledgers forget
/// them.
void keep_disturbed(const std::vector<provider_load>& loads, time_point until,
                    recording::locked_results& keeper) {
  std::vector<recording::disturbed_messages> all;
  const auto take = [&](const std::string& provider, std::string_view direction,
                        channel::octet_ledger& ledger) {
    for (auto& x : ledger.take_disturbed(until))
      all.push_back({provider, direction, std::move(x)});
  };
  for (const auto& x : loads) {
    take(x.name, "up", *x.octets_up);
    take(x.name, "down", *x.octets_down);
  }
  std::ranges::stable_sort(all, {}, [](const auto& m) { return m.x.at; });
  keeper.with([&](recording::results& r) { r.add_disturbed(all, until); });
}

/// Moves the run to its end, or to where it was interrupted.
time_point advance(runtime& time, time_point end,
                   const std::vector<provider_load>& loads, stage& on) {
  const auto& options = on.options;
  const auto start = time.now();
  const auto total_s = options.endless ? 0 : to_seconds(end - start);
  const auto slice = options.realtime ? wall_slice : virtual_slice;
  const auto flush_s = options.realtime ? flush_every_real_s : flush_every_s;
  double flushed_s = 0;
  auto t = start;
  while (t < end && !on.interrupted) {
    t = std::min(t + slice, end);
    time.run_until(t);
    keep_disturbed(loads, t, on.keeper);
    if (options.news)
      tell_news(options, on.shown, on.console);
    const auto wall_s = on.watch.elapsed_s();
    const auto flush = wall_s - flushed_s > flush_s;
    if (flush)
      flushed_s = wall_s;
    const auto offloaded = on.keeper.with([flush](recording::results& r) {
      if (flush)
        r.flush();
      return r.so_far().offloaded_now();
    });
    on.losses.look_at(on.keeper, on.shown, on.console);
    if (!options.endless)
      on.shown.update(to_seconds(t - start), total_s, offloaded, wall_s);
  }
  on.shown.clear();
  return t;
}

/// Refuses a capture that cannot be opened, or that would destroy what this run
/// reads or writes, while nothing has been touched.
void check_capture(const scenario_definition& s, const run_options& options) {
  if (options.pcap.empty())
    return;
  const std::filesystem::path file = options.pcap;
  const auto refuse = [&](std::string_view why) {
    throw input_error(fmt::format("cannot capture into {}: {}; choose another "
                                  "file with --pcap",
                                  options.pcap, why));
  };
  for (const auto& input : s.read_from)
    if (recording::same_place(file, input))
      refuse("the run reads this file");
  const auto& out = options.out;
  if (out
      && (recording::same_place(file, *out)
          || recording::is_result(file, *out)))
    refuse("the run writes its results there");
  constexpr auto anything = "x";
  const auto in_results =
      options.out
      && recording::same_place(file.parent_path() / anything,
                               *options.out / anything);
  if (!in_results) // else its folder may be made yet
    recording::pcap_file::check(file);
}

/// Removes the results of a run that has not begun, as far as that is possible.
void discard(const std::filesystem::path& folder, bool was_there) {
  if (folder.empty())
    return;
  try {
    recording::remove_results(folder);
  } catch (const input_error&) { // why it has not begun is more important
    return;
  }
  std::error_code not_empty;
  if (!was_there)
    std::filesystem::remove(folder, not_empty);
}

struct kept_results {
  std::filesystem::path folder; ///< Empty: none could be made.
  std::shared_ptr<recording::locked_results> keeper;
};

kept_results make_keeper(const std::string& name, std::int64_t seed,
                         const recording::run_info& info,
                         const run_options& options) {
  try {
    const auto folder = recording::make_results_folder(
        options.out, name, seed, options.force, options.changes);
    return {folder, std::make_shared<recording::locked_results>(
                        folder, info, options.when_unwritable)};
  } catch (const storage_error& full) {
    if (options.when_unwritable == recording::write_failure::ends_the_run)
      throw;
    return {{}, std::make_shared<recording::locked_results>(info, full.what())};
  }
}

/// What a run leaves when its actors have gone.
struct played {
  time_point ended;
  std::optional<recording::cpu_table> computed;
  std::vector<std::pair<std::string, double>> decisions; ///< For timing.csv.
  std::string learned; ///< quality.csv; empty: none.
  recording::load_table load;
};

/// What was measured of providers, as far as they had anything to do.
recording::load_table table_of(const std::vector<provider_load>& loads,
                               time_point end) {
  recording::load_table all;
  for (const auto& x : loads) {
    const auto add = [&](std::string_view what, const auto& meter,
                         double busy_w = 0) {
      if (auto read = meter->read();
          read.between(duration{0}, duration::max()).asked > duration{0})
        all.servers.push_back({x.name, what, std::move(read), busy_w});
    };
    add("workers", x.workers, x.worker_w);
    add("uplink", x.cell_up);
    add("downlink", x.cell_down);
    const auto count = [&](std::string_view direction, const auto& octets) {
      if (auto lines = octets->read(end); !lines.empty())
        all.cells.push_back({x.name, direction, std::move(lines)});
    };
    count("up", x.octets_up);
    count("down", x.octets_down);
  }
  return all;
}

/// Says where operators and those who look on find what they want.
void tell_addresses(const stage& on) {
  if (on.watched && !on.watched->address().empty())
    on.console << "figures at " << on.watched->address() << "/metrics"
               << std::endl;
  if (on.live)
    on.console << "live page: " << on.live->address() << std::endl;
}

/// From the first actor to the last.
/// @param on_start  Called once all are there; a run that it refuses has not
///                  begun.
/// @throws start_refused, and whatever ends a run early; the actors have gone
/// then, too, and `has_begun` tells whether there are results.
played play(const scenario_definition& s, process_share here, runtime& time,
            time_point end,
            const std::shared_ptr<recording::locked_results>& keeper, stage& on,
            const std::function<void(const world_actors&)>& on_start,
            bool& has_begun) {
  auto timed = s;
  timed.record.tracks = s.record.tracks || on.live; // which nobody writes
  std::optional<deciding_times> deciding;
  if (on.options.time_decisions)
    deciding = add_timers(timed.policies);
  const auto start = time.now();
  std::shared_ptr<messages::record_sink> sink = keeper;
  if (on.watched)
    sink = on.watched->counting(sink);
  if (on.live) {
    sink = on.live->seeing(sink);
    here.on_heard = on.live->hearing();
  }
  if (on.udp)
    sink = on.udp->sending(sink);
  const auto actors = build(
      time.system(), timed, sink, time.clock(), !on.options.realtime,
      [keeper](const auto& why) { keeper->fail(why); }, here);
  played run;
  try {
    if (on_start)
      on_start(actors);
    has_begun = true;
    if (on.udp && on.options.udp->from)
      on.udp->hear_for(actors, s, time);
    if (on.watched)
      on.watched->ready(actors.loads);
    tell_addresses(on);
    std::optional<recording::cpu_meter> meter;
    if (auto* ledger = actors::ledger_of(time.system())) {
      time.run_until(std::min(start + settling, end));
      meter.emplace(*ledger, time.now());
    }
    run.ended = advance(time, end, actors.loads, on);
    if (on.options.when_ending)
      on.options.when_ending();
    if (on.watched)
      on.watched->ending();
    if (on.udp)
      on.udp->be_deaf();
    if (meter)
      run.computed = meter->read(time.now());
  } catch (const start_refused&) { // by a peer, perhaps a little later
    has_begun = false;
    dismiss(actors, time);
    throw;
  } catch (...) { // the disk is full, say, of a run that this ends
    dismiss(actors, time);
    throw;
  }
  dismiss(actors, time);
  keep_disturbed(actors.loads, time_point::max(), *keeper);
  run.load = table_of(actors.loads, run.ended);
  run.learned = actors.forecasts->learned_csv();
  if (deciding)
    run.decisions = deciding->figures();
  return run;
}

/// Closes the files, and says how it was.
run_outcome finish(const played& run, const recording::run_info& info,
                   const std::filesystem::path& folder, bool is_cut,
                   stage& on) {
  const auto last = on.keeper.with([&](recording::results& r) {
    if (run.computed)
      r.add_cpu(*run.computed);
    r.add_load(run.load);
    r.add_quality(run.learned);
    for (const auto& [name, value] : run.decisions)
      r.add_timing(name, value);
    return r.finish(run.ended, on.watch.elapsed_s(), is_cut,
                    on.stalls ? on.stalls->so_far() : recording::standstill{});
  });
  on.losses.look_at(on.keeper, on.shown, on.console);
  const auto is_lost = on.keeper.loss().has_value();
  const auto is_safe = on.keeper.with([&](const recording::results& r) {
    if (on.options.show != recording::progress::output::quiet)
      on.console << recording::table(r.so_far(), info, last,
                                     is_lost ? "" : fs::absolute(folder),
                                     on.options.colour);
    return r.so_far().safety().ok();
  });
  if (is_lost)
    return run_outcome::failed;
  if (last.interrupted)
    return run_outcome::interrupted;
  return is_safe ? run_outcome::good : run_outcome::failed;
}

std::unique_ptr<runtime> make_runtime(const run_options& options) {
  if (!options.realtime)
    return make_virtual_runtime(
        std::make_shared<job_pool>(std::max(options.threads, 1UL) - 1));
  return options.cpu ? make_accounting_runtime() : make_wall_clock_runtime();
}

} // namespace

std::string configuration_of(scenario_definition s) {
  // A results folder holds its own copies of the files that are named.
  if (!s.map_text.empty())
    s.map_file = "map.toml";
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    if (auto& p = s.providers[k]; !p.map_text.empty())
      p.map = map_copy_of(k);
  if (!s.trace_text.empty())
    s.network.trace = "trace.txt";
  if (!s.policies.forecast.text.empty())
    s.policies.forecast.file = "forecast.csv";
  name_copies(s.policies);
  return "# The effective configuration of this run; `sofof run` takes it.\n"
         + to_toml(std::move(s));
}

run_outcome run(const scenario_definition& s, const run_options& options,
                const std::atomic<bool>& interrupted, std::ostream& console) {
  if (options.cpu && !options.realtime)
    throw input_error("--cpu measures computing time, which passes on the wall "
                      "clock only; add --realtime");
  if (options.metrics && !options.realtime)
    throw input_error("--metrics is for whoever watches a run on the wall "
                      "clock; add --realtime");
  if (options.live && !options.realtime)
    throw input_error("--live is for whoever watches a run on the wall clock; "
                      "add --realtime, or look at it later with sofof report");
  if (options.udp && !options.realtime)
    throw input_error("--udp is for programs that send and hear on the wall "
                      "clock; add --realtime");
  if (options.realtime && options.threads > 1)
    throw input_error("--threads is of virtual time: on the wall clock all "
                      "cores work; leave out one of --threads and --realtime");
  const auto time = make_runtime(options);
  return run_part(s, options, {}, *time, interrupted, console);
}

run_outcome run_part(const scenario_definition& given,
                     const run_options& options, const process_share& here,
                     runtime& time, const std::atomic<bool>& interrupted,
                     std::ostream& console,
                     const std::function<void(const world_actors&)>& on_start) {
  check_capture(given, options);
  auto s = given;
  const running_programs programs{s, deciding_in(s, here)};
  auto info = describe(s, options, here);
  info.time_of_day = time.clock();
  const auto name =
      options.whose.empty() ? s.name : s.name + "-" + options.whose;
  const auto was_there = options.out && std::filesystem::exists(*options.out);
  info.start = time.now();
  // A port that is taken is refused before there are results.
  std::optional<operations> watched;
  if (options.metrics || options.live)
    watched.emplace(
        info, options.role, [&time] { return time.now(); },
        options.more_figures);
  if (options.metrics)
    watched->serve(*options.metrics);
  std::unique_ptr<live_view> live;
  if (options.live)
    live = options.live({s, info, options.role, *watched});
  std::optional<datagram_air> udp;
  if (options.udp)
    udp.emplace(*options.udp);
  if (options.udp)
    console << "datagrams go to " << network::print_address(options.udp->to)
            << std::endl;
  if (options.udp && options.udp->from)
    console << "datagrams are heard at " << udp->address() << std::endl;
  const auto kept = make_keeper(name, s.seed, info, options);
  const auto end = options.endless ? time_point::max() : info.start + s.length;
  programs.on_failure([keeper = kept.keeper](const std::string& sentence) {
    keeper->fail(sentence);
  });
  stage on{options, interrupted, console, *kept.keeper};
  on.watched = watched ? &*watched : nullptr;
  on.live = live.get();
  on.udp = udp ? &*udp : nullptr;
  if (options.realtime)
    on.stalls.emplace();
  auto has_begun = false;
  try {
    const auto run =
        play(s, here, time, end, kept.keeper, on, on_start, has_begun);
    programs.end();
    return finish(run, info, kept.folder, !options.endless && run.ended < end,
                  on);
  } catch (...) {
    if (!has_begun || programs.have_failed())
      discard(kept.folder, was_there);
    throw;
  }
}

} // namespace sofof::scenario
