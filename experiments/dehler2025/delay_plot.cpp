// The paper's delay plot: latency against the number of vehicles.
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

namespace sofof::study {

namespace {

using report::curve;
using report::figure;
using report::paragraph;

constexpr int most_vehicles = 6;

report::figure means(const paper_runs& e) {
  figure f;
  f.title = "Latency of trajectories";
  f.x_label = "vehicles";
  f.y_label = "latency, ms";
  curve ours;
  ours.name = "mean ± standard deviation";
  for (int n = 1; n <= most_vehicles; ++n) {
    const auto x =
        pooled(those(e.delay_plot, 0, std::to_string(n)), "latency_ms");
    ours.x.push_back(n);
    ours.y.push_back(x.mean);
    ours.low.push_back(x.mean - x.deviation);
    ours.high.push_back(x.mean + x.deviation);
  }
  f.curves.push_back(std::move(ours));
  curve theirs;
  theirs.name = "the paper, one vehicle";
  theirs.x = {1};
  theirs.y = {paper::latency_mean_ms};
  theirs.low = {paper::latency_mean_ms - paper::latency_deviation_ms};
  theirs.high = {paper::latency_mean_ms + paper::latency_deviation_ms};
  theirs.drawn = curve::style::points;
  theirs.dashed = true;
  f.curves.push_back(std::move(theirs));
  f.caption = "The band is one standard deviation of all latencies together.";
  return f;
}

report::table numbers(const paper_runs& e) {
  report::table t;
  t.title = "Latency and inter-arrival";
  t.columns = {"vehicles",    "results",           "latency, ms", "paper",
               "above 50 ms", "inter-arrival, ms", "above 100 ms"};
  for (int n = 1; n <= most_vehicles; ++n) {
    const auto runs = those(e.delay_plot, 0, std::to_string(n));
    const auto latency = pooled(runs, "latency_ms");
    const auto gaps = pooled(runs, "interarrival_ms");
    histogram late, long_gaps;
    for (const auto* run : runs) {
      late.add(read_histogram(run->folder, planning, "latency"));
      long_gaps.add(read_histogram(run->folder, planning, "interarrival"));
    }
    t.rows.push_back(
        {std::to_string(n), fmt::format("{:.0f}", latency.count),
         fmt::format("{:.2f} ± {:.2f}", latency.mean, latency.deviation),
         n == 1 ? fmt::format("{:.2f} ± {:.2f}", paper::latency_mean_ms,
                              paper::latency_deviation_ms)
                : "grows",
         fmt::format("{:.4f} %", 100 * late.share_above(paper::max_latency_ms)),
         fmt::format("{:.2f} ± {:.2f}", gaps.mean, gaps.deviation),
         fmt::format("{:.4f} %",
                     100 * long_gaps.share_above(paper::max_interarrival_ms))});
  }
  return t;
}

figure distribution_of(const paper_runs& e, const char* what, const char* title,
                       double limit_ms, const char* limit) {
  figure f;
  f.title = title;
  f.x_label = "ms";
  f.y_label = "share of results";
  for (const int n : {1, 3, most_vehicles}) {
    histogram all;
    for (const auto* run : those(e.delay_plot, 0, std::to_string(n)))
      all.add(read_histogram(run->folder, planning, what));
    f.curves.push_back(
        all.cumulative(n == 1 ? "1 vehicle" : fmt::format("{} vehicles", n)));
  }
  f.marks.emplace_back(limit_ms, limit);
  return f;
}

} // namespace

report::section delay_plot(const paper_runs& e) {
  report::section s{"Latency", {}};
  s.blocks.emplace_back(paragraph{
      "The paper's delay plot has mean and standard deviation of the latency "
      "against the number of vehicles: both grow, 10.54 ± 9.83 ms for one, and "
      "nearly all are below 50 ms."});
  s.blocks.emplace_back(means(e));
  s.blocks.emplace_back(numbers(e));
  s.blocks.emplace_back(distribution_of(e, "latency",
                                        "How latencies are distributed",
                                        paper::max_latency_ms, "l_max"));
  s.blocks.emplace_back(distribution_of(
      e, "interarrival", "How gaps between results are distributed",
      paper::max_interarrival_ms, "Δt_max"));
  s.blocks.emplace_back(paragraph{
      "The channel `paper_sim` is fitted to the paper's mean and deviation for "
      "one vehicle, so that these only tell that the way of the data adds "
      "little of its own. The growth with the number of vehicles is not "
      "fitted: results wait for the one worker at the edge server, which takes "
      "30 % of each latency."});
  return s;
}

} // namespace sofof::study
