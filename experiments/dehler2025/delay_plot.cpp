// The paper's delay plot: latency against the number of vehicles.
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/paper_figures.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace sofof::experiments::study {

namespace {

using report::curve;
using report::figure;
using report::paragraph;

constexpr int most_vehicles = 6;

std::vector<const measured_run*> all_runs(const paper_runs& e, int vehicles) {
  return latency_runs(e, std::to_string(vehicles));
}

spread latency_of(const paper_runs& e, int vehicles) {
  return pooled(all_runs(e, vehicles), "latency_ms");
}

report::figure means(const paper_runs& e, const report_text& text) {
  figure f;
  f.title = "Latency of trajectories";
  f.x_label = "vehicles";
  f.y_label = "latency, ms";
  curve ours;
  ours.name = "mean ± standard deviation";
  for (int n = 1; n <= most_vehicles; ++n) {
    const auto x = latency_of(e, n);
    ours.x.push_back(n);
    ours.y.push_back(x.mean);
    ours.low.push_back(x.mean - x.deviation);
    ours.high.push_back(x.mean + x.deviation);
  }
  f.curves.push_back(std::move(ours));
  curve theirs;
  theirs.name = "the paper's text, one vehicle";
  theirs.x = {1};
  theirs.y = {paper::latency_mean_ms};
  theirs.low = {paper::latency_mean_ms - paper::latency_deviation_ms};
  theirs.high = {paper::latency_mean_ms + paper::latency_deviation_ms};
  theirs.drawn = curve::style::points;
  theirs.dashed = true;
  f.curves.push_back(std::move(theirs));
  f.caption = text.fill("band");
  return f;
}

report::table numbers(const paper_runs& e) {
  report::table t;
  t.title = "Latency and inter-arrival";
  t.columns = {"vehicles",     "results",
               "latency, ms",  "paper",
               "above 50 ms",  "inter-arrival, ms",
               "above 100 ms", "latency at Δt_max = 100 ms, ms"};
  for (int n = 1; n <= most_vehicles; ++n) {
    const auto runs = all_runs(e, n);
    const auto chosen =
        pooled(those(e.delay_plot, 0, std::to_string(n)), "latency_ms");
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
                     100 * long_gaps.share_above(paper::max_interarrival_ms)),
         fmt::format("{:.2f} ± {:.2f}", chosen.mean, chosen.deviation)});
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
    for (const auto* run : all_runs(e, n))
      all.add(read_histogram(run->folder, planning, what));
    f.curves.push_back(
        all.cumulative(n == 1 ? "1 vehicle" : fmt::format("{} vehicles", n)));
  }
  f.marks.emplace_back(limit_ms, limit);
  return f;
}

/// How far ours are from the paper's, to which the channel is fitted.
std::string about_the_fit(const spread& one, const report_text& text) {
  constexpr double little_percent = 5;
  const auto off_by = [](double ours, double theirs) {
    return 100 * std::abs(ours / theirs - 1);
  };
  const auto mean = off_by(one.mean, paper::latency_mean_ms);
  const auto deviation = off_by(one.deviation, paper::latency_deviation_ms);
  if (mean < little_percent && deviation < little_percent)
    return text.fill("little_added");
  return text.fill("much_added",
                   {{"mean_off", fmt::format("{:.0f}", mean)},
                    {"deviation_off", fmt::format("{:.0f}", deviation)}});
}

std::string about_growth(const spread& one, const spread& six,
                         const report_text& text) {
  const auto change = [](double from, double to) {
    return fmt::format("{:+.1f} %", 100 * (to / from - 1));
  };
  return text.fill("growth",
                   {{"mean", change(one.mean, six.mean)},
                    {"deviation", change(one.deviation, six.deviation)}});
}

} // namespace

report::section delay_plot(const paper_runs& e) {
  const auto text = report_text::of("delay_plot");
  report::section s{"Latency", {}};
  s.blocks.emplace_back(paragraph{text.fill(
      "the_paper",
      {{"latency_ms", fmt::format("{:.2f} ± {:.2f}", paper::latency_mean_ms,
                                  paper::latency_deviation_ms)},
       {"l_max_ms", fmt::format("{}", paper::max_latency_ms)}})});
  s.blocks.emplace_back(means(e, text));
  s.blocks.emplace_back(numbers(e));
  s.blocks.emplace_back(distribution_of(e, "latency",
                                        "How latencies are distributed",
                                        paper::max_latency_ms, "l_max"));
  s.blocks.emplace_back(distribution_of(
      e, "interarrival", "How gaps between results are distributed",
      paper::max_interarrival_ms, "Δt_max"));
  const auto one = latency_of(e, 1), six = latency_of(e, most_vehicles);
  s.blocks.emplace_back(
      paragraph{about_the_fit(one, text) + ' ' + about_growth(one, six, text)});
  return s;
}

} // namespace sofof::experiments::study
