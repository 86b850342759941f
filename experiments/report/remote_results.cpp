// Three quantities, each by time and as a distribution.
#include "experiments/report/remote_results.hpp"

#include "base/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace sofof::experiments::report {

namespace {

struct quantity {
  std::string_view name;
  std::string_view axis;
  std::optional<double> (*of)(const cycle_line&);
  duration messages::qos_limits::*limit;
};

constexpr quantity quantities[]{
    {"Latency", "latency, ms",
     [](const cycle_line& x) { return std::optional{x.latency_ms}; },
     &messages::qos_limits::max_latency},
    {"Age of the input", "age of the input, ms",
     [](const cycle_line& x) { return x.input_age_ms; },
     &messages::qos_limits::max_input_age},
    {"Inter-arrival time", "inter-arrival time, ms",
     [](const cycle_line& x) { return x.interarrival_ms; },
     &messages::qos_limits::max_interarrival},
};

/// One result's value.
struct value {
  double at_s = 0;
  double ms = 0;
  double station = 0;
};

/// What becomes one curve: values in the order of their time.
struct series {
  std::string name;
  std::optional<std::size_t> provider; ///< Its place in the configuration.
  std::vector<value> values;
};

std::vector<value> values_of(const recorded_run& run, std::string_view service,
                             const quantity& what,
                             std::optional<std::string_view> provider) {
  std::vector<value> all;
  for (const auto& line : *run.cycles)
    if (line.of.service == service
        && (!provider || line.of.provider == *provider))
      if (const auto ms = what.of(line))
        all.push_back(
            {line.received_s, *ms, static_cast<double>(line.of.station)});
  std::ranges::stable_sort(all, {}, &value::at_s);
  return all;
}

/// Of a run by itself: a series for each provider, in their order.
std::vector<series> by_provider(const recorded_run& run,
                                std::string_view service,
                                const quantity& what) {
  std::vector<series> all;
  std::set<std::string_view> others;
  for (const auto& line : *run.cycles)
    others.insert(line.of.provider);
  const auto& providers = run.what.providers;
  for (std::size_t i = 0; i < providers.size(); ++i)
    if (others.erase(providers[i].name) > 0)
      all.push_back({providers[i].name, i,
                     values_of(run, service, what, providers[i].name)});
  for (const auto name : others)
    all.push_back({name.empty() ? "a provider" : std::string{name},
                   std::nullopt, values_of(run, service, what, name)});
  return all;
}

std::vector<series> series_of(std::span<const recorded_run> runs,
                              std::string_view service, const quantity& what) {
  std::vector<series> all;
  if (runs.size() == 1 && runs[0].cycles)
    all = by_provider(runs[0], service, what);
  else
    for (const auto& run : runs)
      if (run.cycles)
        all.push_back({run.label, std::nullopt,
                       values_of(run, service, what, std::nullopt)});
  std::erase_if(all, [](const series& one) { return one.values.empty(); });
  return all;
}

std::set<double> limits_ms(std::span<const recorded_run> runs,
                           std::string_view service, const quantity& what) {
  std::set<double> all;
  for (const auto& run : runs)
    for (const auto& type : run.what.services)
      if (const auto limit = type->options.limits.*what.limit;
          type->name() == service && limit != duration::max())
        all.insert(to_seconds(limit) * 1000);
  return all;
}

std::string limit_name(double limit_ms) {
  return fmt::format("limit {:g} ms", limit_ms);
}

/// A limit far beyond all values would leave them no room: the caption tells.
class limit_lines {
public:
  limit_lines(const std::set<double>& limits_ms, double longest_ms) {
    constexpr double farthest = 5; // times the longest
    for (const auto limit_ms : limits_ms)
      if (limit_ms <= farthest * longest_ms)
        shown.emplace_back(limit_ms, limit_name(limit_ms));
      else
        caption +=
            fmt::format("{}The {} is far beyond.", caption.empty() ? "" : " ",
                        limit_name(limit_ms));
  }

  std::vector<std::pair<double, std::string>> shown;
  std::string caption;
};

double longest_ms(const std::vector<series>& all) {
  double longest = 0;
  for (const auto& one : all)
    longest = std::max(
        longest, std::ranges::max_element(one.values, {}, &value::ms)->ms);
  return longest;
}

figure by_time(const std::vector<series>& all, const limit_lines& limits,
               const quantity& what) {
  figure shown;
  shown.title = fmt::format("{} by time", what.name);
  shown.x_label = "time, s";
  shown.y_label = what.axis;
  shown.caption = limits.caption;
  shown.levels = limits.shown;
  shown.by_clock = true;
  for (const auto& one : all) {
    auto& points = shown.curves.emplace_back();
    points.name = one.name;
    points.provider = one.provider;
    points.drawn = curve::style::points;
    for (const auto& [at_s, ms, station] : one.values) {
      points.x.push_back(at_s);
      points.y.push_back(ms);
      points.stations.push_back(station);
    }
  }
  return shown;
}

/// The share of values that are x or more: near 1 a distribution hides what
/// this shows, the one in ten thousand that came too late.
figure by_share(std::vector<series> all, const limit_lines& limits,
                const quantity& what) {
  figure shown;
  shown.title = fmt::format("{}, distribution", what.name);
  shown.x_label = what.axis;
  shown.y_label = "share of results, 1 − F";
  shown.caption = limits.caption;
  shown.marks = limits.shown;
  for (auto& one : all) {
    std::ranges::stable_sort(one.values, {}, &value::ms);
    auto& tail = shown.curves.emplace_back();
    tail.name = one.name;
    tail.provider = one.provider;
    tail.drawn = curve::style::tail;
    const auto count = static_cast<double>(one.values.size());
    auto left = count;
    for (const auto& [at_s, ms, station] : one.values) {
      tail.x.push_back(ms);
      tail.y.push_back(left-- / count);
      tail.stations.push_back(station);
    }
  }
  return shown;
}

} // namespace

std::vector<figure> remote_results(std::span<const recorded_run> runs,
                                   std::string_view service) {
  std::vector<figure> figures;
  for (const auto& what : quantities) {
    auto all = series_of(runs, service, what);
    if (all.empty())
      continue;
    const limit_lines limits{limits_ms(runs, service, what), longest_ms(all)};
    figures.push_back(by_time(all, limits, what));
    figures.push_back(by_share(std::move(all), limits, what));
  }
  return figures;
}

} // namespace sofof::experiments::report
