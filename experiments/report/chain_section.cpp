// From responses.csv, scene.csv, and changes of source.
#include "experiments/report/chain_section.hpp"

#include "experiments/report/admitted_times.hpp"
#include "experiments/report/offloading_spans.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

constexpr std::string_view own_computer = "own computer";

/// When a vehicle was there, by what it has recorded.
struct presence {
  double from_s = std::numeric_limits<double>::infinity();
  double until_s = 0;

  void add(double t_s) {
    from_s = std::min(from_s, t_s);
    until_s = std::max(until_s, t_s);
  }
};

/// What one run tells of its chain.
struct chain_record {
  std::vector<std::string> services; ///< In the order of the chain.
  std::vector<response_line> responses;
  std::vector<scene_line> looks; ///< At the scene, by services of the chain.
  std::vector<offloading_span> spans;
  std::map<std::uint64_t, presence> vehicles; ///< By station.
};

chain_record read_chain(const recorded_run& run) {
  chain_record all;
  all.services = scenario::chain_of(run.what);
  if (all.services.size() < 2)
    return all;
  all.responses = read_responses(run.folder);
  std::ranges::stable_sort(all.responses, {}, &response_line::t_s);
  all.looks = read_scene(run.folder);
  const auto is_ours = [&all](const std::string& service) {
    return std::ranges::find(all.services, service) != all.services.end();
  };
  std::erase_if(all.looks,
                [&](const scene_line& x) { return !is_ours(x.service); });
  constexpr auto s_per_ms = 1e-3;
  for (const auto& x : all.responses) {
    all.vehicles[x.station].add(x.t_s);
    all.vehicles[x.station].add(x.t_s + s_per_ms * x.response_ms);
  }
  for (const auto& x : all.looks)
    all.vehicles[x.station].add(x.t_s);
  // What nobody has ended ends with the last that is known of its vehicle.
  all.spans = offloadings_of(run, read_events(run.folder), 0);
  std::erase_if(all.spans, [&](const offloading_span& x) {
    return !is_ours(x.of.service) || !all.vehicles.contains(x.of.station);
  });
  for (auto& x : all.spans) {
    auto& there = all.vehicles[x.of.station];
    if (x.until_s < x.from_s)
      x.until_s = std::max(x.from_s, there.until_s);
    there.add(x.from_s);
    there.add(x.until_s);
  }
  std::ranges::stable_sort(all.spans, {}, &offloading_span::from_s);
  return all;
}

/// @returns the number of a provider among the places of the strips.
std::size_t place_in(figure& of, const recorded_run& run,
                     const std::string& provider) {
  const auto name = provider.empty() ? std::string{"a provider"} : provider;
  const auto found = std::ranges::find(of.places, name,
                                       &decltype(of.places)::value_type::first);
  if (found != of.places.end())
    return static_cast<std::size_t>(found - of.places.begin());
  of.places.emplace_back(name, run.place_of(provider).value_or(0));
  return of.places.size() - 1;
}

void add_strip(figure& to, const recorded_run& run, const chain_record& from,
               const std::string& service) {
  strip all;
  all.name = service;
  for (const auto& [station, there] : from.vehicles) {
    const auto x = static_cast<double>(station);
    auto since_s = there.from_s;
    for (const auto& span : from.spans) {
      if (span.of.station != station || span.of.service != service)
        continue;
      if (since_s < span.from_s)
        all.stays.push_back({x, since_s, span.from_s, 0});
      all.stays.push_back(
          {x, span.from_s, span.until_s, place_in(to, run, span.of.provider)});
      since_s = span.until_s;
    }
    if (since_s < there.until_s)
      all.stays.push_back({x, since_s, there.until_s, 0});
  }
  for (const auto& x : run.episodes)
    if (x.by_requester && x.fallback && x.of.service == service)
      all.fallbacks.push_back({static_cast<double>(x.of.station), x.ended_s});
  to.strips.push_back(std::move(all));
}

void add_point(curve& to, double x, double y, std::uint64_t station) {
  to.x.push_back(x);
  to.y.push_back(y);
  to.stations.push_back(static_cast<double>(station));
}

void sort_by_time(curve& one) {
  std::vector<std::size_t> order(one.x.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return one.x[i]; });
  auto sorted = one;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.x[i] = one.x[order[i]];
    sorted.y[i] = one.y[order[i]];
    sorted.stations[i] = one.stations[order[i]];
  }
  one = std::move(sorted);
}

curve measured(const chain_record& from) {
  curve all;
  all.name = "measured";
  all.drawn = curve::style::points;
  all.means = curve::meaning::measured;
  for (const auto& x : from.responses)
    add_point(all, x.t_s, x.response_ms, x.station);
  return all;
}

/// Changes alone: in between it stays as it was.
curve allowed(const chain_record& from) {
  curve all;
  all.name = "allowed by the scene";
  all.drawn = curve::style::steps;
  all.means = curve::meaning::allowed;
  std::map<std::uint64_t, const scene_line*> last, drawn;
  for (const auto& x : from.looks) {
    auto& before = drawn[x.station];
    if (!before || before->safe_ms != x.safe_ms) {
      add_point(all, x.t_s, x.safe_ms, x.station);
      before = &x;
    }
    last[x.station] = &x;
  }
  for (const auto& [station, x] : last)
    if (x != drawn[station])
      add_point(all, x->t_s, x->safe_ms, station);
  sort_by_time(all);
  return all;
}

/// Where the services of one vehicle are, whenever that changes.
std::map<double, std::vector<bool>> splits_of(std::uint64_t station,
                                              const chain_record& from) {
  const auto& there = from.vehicles.at(station);
  std::map<double, std::vector<bool>> all;
  const std::vector<bool> home(from.services.size());
  all[there.from_s] = home;
  for (const auto& x : from.spans)
    if (x.of.station == station)
      all[x.from_s] = all[x.until_s] = home;
  for (const auto& x : from.spans) {
    if (x.of.station != station)
      continue;
    const auto k = static_cast<std::size_t>(
        std::ranges::find(from.services, x.of.service) - from.services.begin());
    for (auto i = all.find(x.from_s); i->first < x.until_s; ++i)
      i->second[k] = true;
  }
  if (there.from_s < there.until_s)
    all[there.until_s] = std::prev(all.lower_bound(there.until_s))->second;
  return all;
}

/// Nothing where some split of a vehicle has no limit.
curve admitted(const recorded_run& run, const chain_record& from) {
  curve all;
  all.name = "admitted by the split's limits";
  all.drawn = curve::style::steps;
  all.dashed = true;
  all.means = curve::meaning::admitted;
  const admitted_times times{run.what};
  for (const auto& [station, there] : from.vehicles)
    for (const auto& [t_s, away] : splits_of(station, from)) {
      const auto most = times.of(station, away);
      if (!most)
        return {};
      add_point(all, t_s, to_milliseconds(*most), station);
    }
  sort_by_time(all);
  return all;
}

figure responses_of(const recorded_run& run, const chain_record& from,
                    bool alone) {
  figure all;
  all.title = alone ? "Split and response time" : run.label;
  all.x_label = "time, s";
  all.y_label = "response time, ms";
  all.by_clock = true;
  all.log_y = true;
  all.places.emplace_back(own_computer, std::nullopt);
  for (const auto& service : from.services)
    add_strip(all, run, from, service);
  if (auto points = measured(from); !points.x.empty()) {
    all.curves.push_back(std::move(points));
    all.caption =
        "Measured: each look of the vehicle's sensors, until the first "
        "control value that depends on it. ";
  }
  if (auto scene = allowed(from); !scene.x.empty()) {
    all.curves.push_back(std::move(scene));
    all.caption +=
        "Allowed: the longest response time under which the scene is "
        "safe, 5000 ms if nothing is near; 0 is at the lower edge. ";
  } else {
    all.caption +=
        "No policy asked what the scene allows: governor `rss` does. ";
  }
  if (auto limits = admitted(run, from); !limits.x.empty()) {
    all.curves.push_back(std::move(limits));
    all.caption +=
        "Admitted: the longest time until a plan by it that the limits "
        "let pass with the services where they are, and with the own "
        "functions that take over when one is broken.";
  }
  return all;
}

} // namespace

section chain_section(std::span<const recorded_run> runs) {
  section all{.title = "Chain", .blocks = {}};
  for (const auto& run : runs)
    if (const auto chain = read_chain(run); !chain.vehicles.empty())
      all.blocks.emplace_back(responses_of(run, chain, runs.size() == 1));
  return all;
}

} // namespace sofof::experiments::report
