// Two quantities, each by time and as a distribution.
#include "experiments/report/remote_results.hpp"

#include "base/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

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
    {"Inter-arrival time", "inter-arrival time, ms",
     [](const cycle_line& x) { return x.interarrival_ms; },
     &messages::qos_limits::max_interarrival},
};

/// One run's values in the order of their time.
struct series {
  std::string name;
  std::vector<double> at_s;
  std::vector<double> ms;
};

series series_of(const recorded_run& run, std::string_view service,
                 const quantity& what) {
  std::vector<std::pair<double, double>> points;
  for (const auto& line : *run.cycles)
    if (const auto ms = what.of(line); ms && line.of.service == service)
      points.emplace_back(line.received_s, *ms);
  std::ranges::stable_sort(points, {}, &std::pair<double, double>::first);
  series all{run.label, {}, {}};
  for (const auto& [at_s, ms] : points) {
    all.at_s.push_back(at_s);
    all.ms.push_back(ms);
  }
  return all;
}

std::set<double> limits_ms(std::span<const recorded_run> runs,
                           std::string_view service, const quantity& what) {
  std::set<double> all;
  for (const auto& run : runs)
    for (const auto& type : run.what.services)
      if (type->name() == service)
        all.insert(to_seconds(type->options.limits.*what.limit) * 1000);
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
        shown_ms.push_back(limit_ms);
      else
        caption +=
            fmt::format("{}The {} is far beyond.", caption.empty() ? "" : " ",
                        limit_name(limit_ms));
  }

  std::vector<double> shown_ms;
  std::string caption;
};

double longest_ms(const std::vector<series>& all) {
  double longest = 0;
  for (const auto& one : all)
    longest = std::max(longest, *std::ranges::max_element(one.ms));
  return longest;
}

figure by_time(const std::vector<series>& all, const limit_lines& limits,
               const quantity& what) {
  figure shown;
  shown.title = fmt::format("{} by time", what.name);
  shown.x_label = "time, s";
  shown.y_label = what.axis;
  shown.caption = limits.caption;
  double end_s = 0;
  for (const auto& one : all) {
    end_s = std::max(end_s, one.at_s.back());
    auto& points = shown.curves.emplace_back();
    points.name = one.name;
    points.x = one.at_s;
    points.y = one.ms;
    points.drawn = curve::style::points;
  }
  for (const auto limit_ms : limits.shown_ms) {
    auto& line = shown.curves.emplace_back();
    line.name = limit_name(limit_ms);
    line.x = {0, end_s};
    line.y = {limit_ms, limit_ms};
    line.dashed = true;
  }
  return shown;
}

figure by_share(std::vector<series> all, const limit_lines& limits,
                const quantity& what) {
  figure shown;
  shown.title = fmt::format("{}, cumulative distribution", what.name);
  shown.x_label = what.axis;
  shown.y_label = "share of results";
  shown.caption = limits.caption;
  for (auto& one : all) {
    std::ranges::sort(one.ms);
    auto& steps = shown.curves.emplace_back();
    steps.name = one.name;
    steps.drawn = curve::style::steps;
    const auto count = static_cast<double>(one.ms.size());
    for (std::size_t i = 1; i <= one.ms.size(); ++i)
      steps.y.push_back(static_cast<double>(i) / count);
    steps.x = std::move(one.ms);
  }
  for (const auto limit_ms : limits.shown_ms)
    shown.marks.emplace_back(limit_ms, limit_name(limit_ms));
  return shown;
}

} // namespace

std::vector<figure> remote_results(std::span<const recorded_run> runs,
                                   std::string_view service) {
  std::vector<figure> figures;
  for (const auto& what : quantities) {
    std::vector<series> all;
    for (const auto& run : runs) {
      if (!run.cycles)
        continue;
      auto one = series_of(run, service, what);
      if (runs.size() == 1)
        one.name = "results";
      if (!one.ms.empty())
        all.push_back(std::move(one));
    }
    if (all.empty())
      continue;
    const limit_lines limits{limits_ms(runs, service, what), longest_ms(all)};
    figures.push_back(by_time(all, limits, what));
    figures.push_back(by_share(std::move(all), limits, what));
  }
  return figures;
}

} // namespace sofof::experiments::report
