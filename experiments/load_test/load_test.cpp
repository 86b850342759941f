// One drive after the other, with more vehicles each time.
#include "experiments/load_test/load_test.hpp"

#include "base/input_error.hpp"
#include "base/stopwatch.hpp"
#include "experiments/load_test/load_search.hpp"
#include "experiments/sweep/work_folder.hpp"
#include "scenario/hosts.hpp"
#include "scenario/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <ostream>
#include <sstream>
#include <string_view>
#include <sys/resource.h>
#include <thread>
#include <utility>

namespace sofof::experiments::load_test {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::int64_t first_tried = 10;

/// Of vehicles: they plan for themselves for a second, then ask, and their
/// first plans take longer. Their end takes a moment, too.
constexpr duration settling = 4s;
constexpr duration ending = 500ms;

/// Of results.
constexpr double share_in_time = 0.99;

/// From here on the vehicles' side itself may be what is slow.
constexpr double busy = 0.9;

double computed_s() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  constexpr double per_us = 1e-6;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec)
           + per_us * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// @returns the scenario with so many vehicles, which plan as cheaply as they
/// can on board and offload whatever is offered.
scenario::scenario_definition with_vehicles(const load_options& options,
                                            std::int64_t vehicles) {
  auto changes = options.changes;
  changes.push_back(fmt::format("fleet.0.count={}", vehicles));
  changes.emplace_back("policies.lodm=always");
  changes.emplace_back("record.cycles=true");
  const auto s = scenario::load_scenario(options.scenario, changes);
  const auto* planning = scenario::planning_service(s);
  if (!planning)
    throw input_error(fmt::format("{}: no service plans how vehicles drive, so "
                                  "there is no load to make; add a "
                                  "[[service]] trajectory_planning",
                                  options.scenario.string()));
  changes.push_back(
      fmt::format("service.{}.planner=lane_follow", planning->name()));
  changes.push_back(
      fmt::format("--duration={}ms",
                  to_milliseconds(settling + options.measured + ending)));
  return scenario::load_scenario(options.scenario, changes);
}

/// @param news  Of the connection, line by line.
std::string nobody_served(const load_options& options, std::int64_t vehicles,
                          std::string_view news) {
  while (news.ends_with('\n'))
    news.remove_suffix(1);
  return fmt::format("none of {} vehicles was served by the provider at {}; {}",
                     vehicles, network::print_address(options.at),
                     news.starts_with("connected")
                         ? "do its area and its CODM let them in?"
                         : news);
}

/// Plays one number of vehicles.
/// @param to  Gets the files of its drive.
/// @returns nullopt if it was interrupted.
std::optional<served_step> play(const load_options& options,
                                std::int64_t vehicles, const fs::path& to,
                                const std::atomic<bool>& interrupted) {
  const auto s = with_vehicles(options, vehicles);
  scenario::drive_options drive;
  drive.providers = {{options.provider, options.at}};
  drive.keys = options.keys;
  scenario::run_options run;
  run.out = to;
  run.force = true;
  run.version = options.version;
  std::ostringstream news;
  const stopwatch watch;
  const auto before_s = computed_s();
  if (scenario::drive(s, drive, run, interrupted, news)
      == scenario::run_outcome::interrupted)
    return std::nullopt;
  served_step step;
  step.cores = (computed_s() - before_s) / watch.elapsed_s();
  step.vehicles = vehicles;
  const auto* service = scenario::planning_service(s);
  const auto lines =
      report::read_cycles(to, [service](const report::session_key& x) {
        return x.service == service->name();
      });
  assert(lines);
  count_results(*lines,
                {to_seconds(settling), to_seconds(settling + options.measured),
                 service->options.period},
                step);
  if (step.results == 0)
    throw input_error(
        fmt::format("none of {} vehicles was served by the provider at {}; {}",
                    vehicles, network::print_address(options.at),
                    news.str().empty() ? "see whether its area holds them"
                                       : "it says: " + news.str()));
  if (const auto summary = report::read_summary(to))
    if (const auto x = summary->figures.find("fallbacks");
        x != summary->figures.end())
      step.fallbacks = static_cast<std::uint64_t>(x->second);
  return step;
}

std::string line_of(const served_step& x) {
  const auto of = [](const distribution& d, double p) {
    return d.quantile_ms(p).value_or(0);
  };
  return fmt::format(
      "{:8} {:7} {:10.0f} {:8.2f} {:8.2f} {:8.2f} {:12.2f} {:10} {:10.2f}\n",
      x.vehicles, x.served, x.exchanged_per_s(), of(x.response, 0.5),
      of(x.response, share_in_time), x.response.ms().max().value_or(0),
      of(x.latency, share_in_time), x.fallbacks, x.cores);
}

constexpr auto heading =
    "                              waiting + computing, ms   latency, ms      "
    "       cores of\n"
    "vehicles  served  results/s      p50      p99      max          p99  "
    "fallbacks  this side\n";

/// The steps so far, and what follows from them.
class log {
public:
  log(const load_options& options, std::ostream& screen)
      : options_{options}, screen_{screen} {}

  /// @returns whether so many are carried.
  bool add(const served_step& step) {
    if (std::exchange(is_empty_, false))
      screen_ << heading;
    screen_ << line_of(step) << std::flush;
    const auto carried = is_carried(step, options_.within);
    if (carried && step.vehicles > carried_)
      carried_ = step.vehicles;
    if (!carried && (!too_many_ || step.vehicles < *too_many_))
      too_many_ = step.vehicles;
    const auto cores = std::max(1U, std::thread::hardware_concurrency());
    is_busy_ = is_busy_ || step.cores > busy * cores;
    is_refusing_ =
        is_refusing_ || step.served < static_cast<std::size_t>(step.vehicles);
    return carried;
  }

  void conclude() const {
    const auto within_ms = to_milliseconds(options_.within);
    if (carried_ == 0 && too_many_)
      screen_ << fmt::format("{} vehicles are too many", *too_many_);
    else
      screen_ << fmt::format("The provider carries {} vehicles", carried_);
    screen_ << (too_many_ && carried_ > 0
                    ? fmt::format(", and not {}", *too_many_)
                    : "")
            << fmt::format(": 99 of 100 results come, and within {:g} ms of "
                           "waiting and computing.\n",
                           within_ms);
    if (is_refusing_)
      screen_ << "Not all were served: the provider's area does not hold them, "
                 "or its CODM refused some.\n";
    if (is_busy_)
      screen_ << "This machine was busy with the vehicles: play them on "
                 "another one.\n";
  }

private:
  const load_options& options_;
  std::ostream& screen_;
  std::int64_t carried_ = 0;
  std::optional<std::int64_t> too_many_;
  bool is_empty_ = true, is_busy_ = false, is_refusing_ = false;
};

} // namespace

bool is_carried(const served_step& step, duration within) {
  const auto late_ms = step.response.quantile_ms(share_in_time);
  return static_cast<double>(step.results)
             >= share_in_time * static_cast<double>(step.due)
         && late_ms && *late_ms <= to_milliseconds(within);
}

bool test_load(const load_options& options,
               const std::atomic<bool>& interrupted, std::ostream& screen) {
  assert(options.most > 0);
  std::optional<work_folder> ours;
  if (options.out.empty())
    ours.emplace(fs::temp_directory_path());
  const auto folder = ours ? ours->path() : options.out;
  log steps{options, screen};
  const auto try_with = [&](std::int64_t vehicles) -> std::optional<bool> {
    const auto step =
        play(options, vehicles, folder / fmt::format("{}_vehicles", vehicles),
             interrupted);
    return step ? std::optional{steps.add(*step)} : std::nullopt;
  };
  if (!options.vehicles.empty()) {
    for (const auto vehicles : options.vehicles)
      if (!try_with(vehicles))
        return false;
  } else {
    load_search search{std::min(first_tried, options.most), options.most};
    while (const auto vehicles = search.next()) {
      const auto carried = try_with(*vehicles);
      if (!carried)
        return false;
      search.add(*vehicles, *carried);
    }
  }
  steps.conclude();
  return true;
}

} // namespace sofof::experiments::load_test
