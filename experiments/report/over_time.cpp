// From tracks.csv and the episodes.
#include "experiments/report/over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

using runs_view = std::span<const recorded_run>;

/// All vehicles in one second.
struct tracked_second {
  std::size_t count = 0;
  std::size_t remote = 0;
  double speed_sum_mps = 0;
  double slowest_mps = std::numeric_limits<double>::infinity();
  double fastest_mps = 0;
};

std::map<double, tracked_second> seconds_of(const recorded_run& run) {
  std::map<double, tracked_second> all;
  const auto tracks = read_tracks(run.folder);
  if (!tracks)
    return all;
  for (const auto& x : *tracks) {
    auto& one = all[std::floor(x.t_s)];
    ++one.count;
    one.remote += x.remote ? 1 : 0;
    one.speed_sum_mps += x.speed_mps;
    one.slowest_mps = std::min(one.slowest_mps, x.speed_mps);
    one.fastest_mps = std::max(one.fastest_mps, x.speed_mps);
  }
  return all;
}

figure empty_figure(std::string title, std::string y_label) {
  figure all;
  all.title = std::move(title);
  all.x_label = "time, s";
  all.y_label = std::move(y_label);
  all.by_clock = true;
  return all;
}

std::string curve_name(const recorded_run& run, runs_view runs) {
  return runs.size() == 1 ? "all vehicles" : run.label;
}

void add_tracks(section& to, runs_view runs) {
  auto speed = empty_figure("Mean speed by time", "speed, m/s");
  auto share = empty_figure("Offloaded vehicles by time", "of all vehicles, %");
  if (runs.size() == 1)
    speed.caption = "The band goes from the slowest to the fastest.";
  for (const auto& run : runs) {
    curve fast, offloaded;
    fast.name = offloaded.name = curve_name(run, runs);
    for (const auto& [t_s, x] : seconds_of(run)) {
      const auto count = static_cast<double>(x.count);
      fast.x.push_back(t_s);
      fast.y.push_back(x.speed_sum_mps / count);
      if (runs.size() == 1) {
        fast.low.push_back(x.slowest_mps);
        fast.high.push_back(x.fastest_mps);
      }
      offloaded.x.push_back(t_s);
      offloaded.y.push_back(100 * static_cast<double>(x.remote) / count);
    }
    if (fast.x.empty())
      continue;
    speed.curves.push_back(std::move(fast));
    share.curves.push_back(std::move(offloaded));
  }
  for (auto* one : {&speed, &share})
    if (!one->curves.empty())
      to.blocks.emplace_back(std::move(*one));
}

/// @returns t_off of the episodes of a run, by provider where it is alone.
std::map<std::string, curve>
times_of(const recorded_run& run, std::string_view service, runs_view runs) {
  std::vector<const episode_line*> ended;
  for (const auto& x : run.episodes)
    if (x.by_requester && x.t_off_s && !x.is_cut_off()
        && x.of.service == service)
      ended.push_back(&x);
  std::ranges::stable_sort(ended, {},
                           [](const episode_line* x) { return x->ended_s; });
  std::map<std::string, curve> all;
  for (const auto* x : ended) {
    auto& to = all[runs.size() == 1 ? x->of.provider : run.label];
    if (runs.size() == 1)
      to.provider = run.place_of(x->of.provider);
    to.drawn = curve::style::points;
    to.x.push_back(x->ended_s);
    to.y.push_back(*x->t_off_s);
    to.stations.push_back(static_cast<double>(x->of.station));
  }
  return all;
}

} // namespace

section over_time(runs_view runs) {
  section all{.title = "Over time", .blocks = {}};
  add_tracks(all, runs);
  for (const auto& service : services_of(runs)) {
    auto times = empty_figure(fmt::format("t_off by end, {}", service),
                              "offloaded for, s");
    times.caption = "A point for each episode, where it ended.";
    for (const auto& run : runs)
      for (auto& [name, one] : times_of(run, service, runs)) {
        one.name = name;
        times.curves.push_back(std::move(one));
      }
    if (!times.curves.empty())
      all.blocks.emplace_back(std::move(times));
  }
  return all;
}

} // namespace sofof::experiments::report
